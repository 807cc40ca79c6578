// A short, repeatable run of what a fuzzer does for hours: every file of a corpus, and damaged copies of them.
//   short_run CORPUS TIMES
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

std::vector<Bytes> read_corpus(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path());
  std::sort(names.begin(), names.end());
  std::vector<Bytes> corpus;
  for (const auto& name : names) {
    std::ifstream in(name, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return corpus;
}

class Damage {
 public:
  explicit Damage(const std::vector<Bytes>& corpus) : corpus_(corpus) {}

  Bytes next() {
    Bytes bytes = corpus_[below(corpus_.size())];
    for (std::size_t change = 1 + below(4); change > 0 && !bytes.empty(); --change) {
      switch (below(4)) {
        case 0:
          overwrite(bytes);
          break;
        case 1:
          take_away(bytes);
          break;
        case 2:
          put_in(bytes, part_of(corpus_[below(corpus_.size())]));
          break;
        default:
          put_in(bytes, part_of(bytes));
          break;
      }
    }
    if (below(20) == 0) bytes.resize(below(bytes.size() + 1));
    return bytes;
  }

 private:
  std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random_); }

  void overwrite(Bytes& bytes) {
    const std::size_t at = below(bytes.size()), width = std::size_t{1} << below(4);
    const std::uint8_t values[] = {0, 1, 0x7f, 0x80, 0xff, '-', '9', '"', static_cast<std::uint8_t>(below(256))};
    const std::uint8_t value = values[below(std::size(values))];
    for (std::size_t i = at; i < std::min(at + width, bytes.size()); ++i) bytes[i] = value;
  }

  void take_away(Bytes& bytes) {
    const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size()));
    const std::size_t left = static_cast<std::size_t>(bytes.end() - first);
    bytes.erase(first, first + static_cast<std::ptrdiff_t>(std::min(left, 1 + below(16))));
  }

  void put_in(Bytes& bytes, const Bytes& part) {
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size() + 1)), part.begin(), part.end());
  }

  Bytes part_of(const Bytes& bytes) {
    if (bytes.empty()) return {};
    const std::size_t first = below(bytes.size());
    const std::size_t end = std::min(bytes.size(), first + 1 + below(32));
    return {bytes.begin() + static_cast<std::ptrdiff_t>(first), bytes.begin() + static_cast<std::ptrdiff_t>(end)};
  }

  const std::vector<Bytes>& corpus_;
  std::mt19937 random_{7};
};

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::fprintf(stderr, "usage: %s CORPUS TIMES\n", words[0]);
    return 2;
  }
  const std::vector<Bytes> corpus = read_corpus(words[1]);
  if (corpus.empty()) {
    std::fprintf(stderr, "%s: holds no files\n", words[1]);
    return 2;
  }
  for (const Bytes& bytes : corpus) LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  Damage damage(corpus);
  const int times = std::atoi(words[2]);
  for (int i = 0; i < times; ++i) {
    const Bytes bytes = damage.next();
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::printf("%zu files and %d damaged copies read\n", corpus.size(), times);
  return 0;
}
