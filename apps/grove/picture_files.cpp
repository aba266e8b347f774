#include "picture_files.h"

#include <algorithm>
#include <filesystem>

#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "grove/render/image/write_exr.h"
#include "grove/render/view.h"

namespace grove::app {
namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

}  // namespace

void check_pictures(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    const std::string extension = extension_of(path);
    if (extension != ".exr" && extension != ".png" && extension != ".film") {
      throw UsageError("--output: '" + path +
                       "' has an unknown extension; images are written as .exr (linear), .png (for the eye) or .film (to merge)");
    }
  }
  for (const std::string& path : paths) check_writable(path);
}

bool has_film(const std::vector<std::string>& paths) {
  return std::ranges::any_of(paths, [](const std::string& path) { return extension_of(path) == ".film"; });
}

bool has_exr(const std::vector<std::string>& paths) {
  return std::ranges::any_of(paths, [](const std::string& path) { return extension_of(path) == ".exr"; });
}

FilmHeader film_header(const std::string& source, const Scene& scene, const SceneAccelerator& accelerator, const RenderSettings& settings) {
  const View view = choose_view(scene, settings);
  FilmHeader header;
  header.scene = source;
  header.picture = picture_identity(scene, accelerator, settings);
  header.width = view.width;
  header.height = view.height;
  header.samples_per_pixel = settings.samples_per_pixel;
  header.part = settings.part;
  header.noise = settings.noise;
  if (header.part.end_sample == 0) header.part.end_sample = settings.samples_per_pixel;
  return header;
}

FilmHeader with_result(FilmHeader header, const RenderResult& result) {
  header.part = result.part;
  header.is_finished = !result.interrupted && !result.out_of_time;
  header.rays_traced = result.rays_traced;
  header.seconds = result.seconds;
  return header;
}

void write_pictures(const std::vector<std::string>& paths, const RenderResult& result, const PictureSettings& settings,
                    const FilmHeader& header, const Console& console) {
  for (const std::string& path : paths) {
    console.status("writing " + path);
    const std::string extension = extension_of(path);
    if (extension == ".exr") {
      write_exr(result, settings.layers, path);
    } else if (extension == ".png") {
      write_png(result, settings.display, path);
    } else {
      write_film(with_result(header, result), result.film, path);
    }
    console.say("wrote      " + path);
  }
}

}  // namespace grove::app
