#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace rinkaku::fluffy {

struct TransmissionOptions {
  double threshold = 0.5;  ///< the luminance, 0 to 1, at which the lowest layer turns transparent
  enum class Keep { Above, Below } keep = Keep::Above;  ///< what stays: what is lighter or darker than the threshold
  int layers = 8;
  double taper =
      1.6;  ///< above 0: how fast tufts get thinner from layer to layer; what is kept shrinks with this power
  enum class Paint { Tone, Texture } paint = Paint::Tone;
  double contrast = 0.2;  ///< 0 to 1: with Paint::Tone, how much darker a tuft's foot is than its tip
};

/// A texture with transparent hollows, one picture for each layer of fluff. RGBA of 8 bits, premultiplied, so that
/// averaging pixels or laying them over a plate brings no fringe of what was cut away; sRGB-encoded; rows from the top,
/// layers one after the other, the one nearest to the skin first. It repeats.
struct TransmissionImage {
  int width_px = 0;
  int height_px = 0;
  int layers = 0;
  std::vector<std::uint8_t> rgba;
  double kept = 0;  ///< the lowest layer's share of opaque texels
};

/// Makes the transmission image of a texture by a threshold of luminance (Rec. 709 weights on encoded values).
///
/// The first layer is as printed: what passes the threshold stays, with an edge one texel wide. Each further one has a
/// higher threshold, such that of n layers the k-th (from 0) keeps (1 - k / n)^taper as much: tufts that get thinner.
/// With Paint::Tone the colour is a grey to multiply the body's with, 1 at the tips of tufts.
/// Throws Error (Input) naming `where` if the threshold keeps nothing or everything. Cost: about 20 ms for 512 x 512.
/// Yamachi, Shindo and Matuda, 2, step 3.
TransmissionImage make_transmission(const mesh::Texture& texture, const TransmissionOptions& options,
                                    const char* where);

}  // namespace rinkaku::fluffy
