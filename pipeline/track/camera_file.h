#pragma once

#include <filesystem>
#include <optional>

#include "pipeline/frame/camera_model.h"

namespace rinkaku::track {

/// Reads camera intrinsics as OpenCV's calibration writes them (YAML, XML or JSON): camera_matrix,
/// distortion_coefficients, image_width, image_height.
///
/// Lengths in pixels; pixel (0, 0) is the centre of the top left pixel. 4, 5, 8, 12 or 14 distortion coefficients (of
/// 14 the last two, tau, must be 0). Other keys are let be. Throws Error (Input) naming the file and the remedy: not
/// readable or not such a file, a key missing or in another case, a matrix that is not 3x3, skew, values that are not
/// finite, a focal length or size that is not positive, fisheye models. Any thread.
CameraModel read_camera(const std::filesystem::path& file);

/// What calibrate() found, for the camera file's reader to judge.
struct CalibrationNote {
  double rms_px = 0;
  int views = 0;
};

/// Writes a camera file that read_camera() and OpenCV read: as few distortion coefficients as hold them all (5, 8 or
/// 12). YAML, or XML or JSON by the name's ending. Replaces the file if there is one, and only once it is whole. Throws
/// Error (Runtime) if it can't be written.
void write_camera(const std::filesystem::path& file, const CameraModel& camera,
                  const std::optional<CalibrationNote>& note = {});

/// Throws Error (Input) naming both sizes and the remedy if the camera was calibrated for another size of picture.
void check_resolution(const CameraModel& camera, const std::filesystem::path& file, int width_px, int height_px);

}  // namespace rinkaku::track
