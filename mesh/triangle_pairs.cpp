#include "mesh/triangle_pairs.h"

#include <algorithm>
#include <numeric>

#include <glm/common.hpp>

namespace rinkaku::mesh {
namespace {

struct Bounds {
  glm::vec3 min{3e38f};
  glm::vec3 max{-3e38f};
  void add(const Bounds& more) {
    min = glm::min(min, more.min);
    max = glm::max(max, more.max);
  }
};

bool meet(const Bounds& a, const Bounds& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z &&
         b.min.z <= a.max.z;
}

// A face's box, as the tree sorts them.
struct Leaf {
  Bounds bounds;
  std::uint32_t face = 0;
  std::uint32_t component = 0;
};

// A run of leaves. Of an inner node, one child follows it and the other is at `right`.
struct Node {
  Bounds bounds;
  std::uint32_t first = 0, count = 0;
  std::uint32_t right = 0;          // 0: no children
  std::uint32_t component = kNone;  // of all its faces; kNone if they differ
};

class Tree {
 public:
  explicit Tree(const Topology& topology) {
    leaves_.reserve(topology.faces.size());
    for (std::uint32_t f = 0; f < topology.faces.size(); ++f) {
      Leaf leaf{{}, f, topology.component[f]};
      for (int k = 0; k < 3; ++k) {
        const glm::vec3& p = topology.points[topology.faces[f][k]];
        leaf.bounds.add({p, p});
      }
      leaves_.push_back(leaf);
    }
    nodes_.reserve(leaves_.size());
    if (!leaves_.empty()) build(0, static_cast<std::uint32_t>(leaves_.size()));
  }

  std::vector<TrianglePair> pairs() {
    if (!nodes_.empty()) within(0);
    return std::move(pairs_);
  }

 private:
  static constexpr std::uint32_t most_in_leaf = 4;

  std::uint32_t build(std::uint32_t first, std::uint32_t count) {
    const auto at = static_cast<std::uint32_t>(nodes_.size());
    Node node;
    node.first = first, node.count = count, node.component = leaves_[first].component;
    Bounds centres;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Leaf& leaf = leaves_[i];
      node.bounds.add(leaf.bounds);
      const glm::vec3 twice_centre = leaf.bounds.min + leaf.bounds.max;
      centres.add({twice_centre, twice_centre});
      if (leaf.component != node.component) node.component = kNone;
    }
    nodes_.push_back(node);
    if (count <= most_in_leaf) return at;
    const glm::vec3 extent = centres.max - centres.min;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const auto begin = leaves_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [axis](const Leaf& a, const Leaf& b) {
      return a.bounds.min[axis] + a.bounds.max[axis] < b.bounds.min[axis] + b.bounds.max[axis];
    });
    build(first, count / 2);
    nodes_[at].right = build(first + count / 2, count - count / 2);
    return at;
  }

  void within(std::uint32_t n) {
    const Node& node = nodes_[n];
    if (node.component != kNone) return;
    if (node.right == 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        for (std::uint32_t k = i + 1; k < node.first + node.count; ++k) compare(leaves_[i], leaves_[k]);
      }
      return;
    }
    within(n + 1);
    within(node.right);
    between(n + 1, node.right);
  }

  void between(std::uint32_t m, std::uint32_t n) {
    const Node &a = nodes_[m], &b = nodes_[n];
    if (!meet(a.bounds, b.bounds) || (a.component != kNone && a.component == b.component)) return;
    if (a.right == 0 && b.right == 0) {
      for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
        for (std::uint32_t k = b.first; k < b.first + b.count; ++k) compare(leaves_[i], leaves_[k]);
      }
    } else if (b.right == 0 || (a.right != 0 && a.count >= b.count)) {
      between(m + 1, n);
      between(a.right, n);
    } else {
      between(m, n + 1);
      between(m, b.right);
    }
  }

  void compare(const Leaf& a, const Leaf& b) {
    if (a.component != b.component && meet(a.bounds, b.bounds)) pairs_.push_back({a.face, b.face});
  }

  std::vector<Leaf> leaves_;
  std::vector<Node> nodes_;
  std::vector<TrianglePair> pairs_;
};

}  // namespace

std::vector<TrianglePair> close_pairs(const Topology& topology) {
  if (topology.component_count <= 1) return {};
  return Tree(topology).pairs();
}

}  // namespace rinkaku::mesh
