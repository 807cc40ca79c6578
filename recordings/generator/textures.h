#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace rinkaku::recordings {

/// Pictures of materials, in sRGB (OpenCV's BGR order). Each is a function of its arguments only.
cv::Mat3b wood(int width_px, int height_px, float px_per_m, cv::Vec3b light, cv::Vec3b dark, float plank_m,
               unsigned seed);
cv::Mat3b plaster(int width_px, int height_px, float px_per_m, cv::Vec3b colour, float roughness, unsigned seed);
cv::Mat3b cloth(int width_px, int height_px, float px_per_thread, cv::Vec3b warp, cv::Vec3b weft, unsigned seed);
cv::Mat3b page_edges(int width_px, int height_px, unsigned seed);
cv::Mat3b book_cover(int width_px, int height_px, cv::Vec3b colour, const std::string& title, bool moon, unsigned seed);
cv::Mat3b notebook_page(int width_px, int height_px, unsigned seed);
cv::Mat3b sticky_note(int size_px, const std::string& words, unsigned seed);
cv::Mat3b glazed_mug(int width_px, int height_px, unsigned seed);
cv::Mat3b leaf(int width_px, int height_px, unsigned seed);

}  // namespace rinkaku::recordings
