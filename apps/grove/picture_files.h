#pragma once

#include <string>
#include <vector>

#include "console.h"
#include "grove/render/image/write_png.h"
#include "grove/render/layers/layer_set.h"
#include "grove/render/render.h"
#include "grove/render/saved/film_file.h"

namespace grove::app {

/// Throws UsageError for a name whose extension is none that pictures are written with, OutputError for one that cannot be written.
void check_pictures(const std::vector<std::string>& paths);

/// Whether one of them is a .film.
[[nodiscard]] bool has_film(const std::vector<std::string>& paths);

/// Whether one of them is an .exr.
[[nodiscard]] bool has_exr(const std::vector<std::string>& paths);

/// The header of a film that `render` makes with these settings; rays and seconds are for `with_result` to fill in.
[[nodiscard]] FilmHeader film_header(const std::string& source, const Scene& scene, const SceneAccelerator& accelerator,
                                     const RenderSettings& settings);

/// The header with what the result says of itself.
[[nodiscard]] FilmHeader with_result(FilmHeader header, const RenderResult& result);

/// What pictures show of a result.
struct PictureSettings {
  DisplaySettings display;              ///< of a .png
  LayerSet layers = LayerSet::usual();  ///< of an .exr
};

/// Writes the picture to each of the files, and says so. The header is used for films only.
void write_pictures(const std::vector<std::string>& paths, const RenderResult& result, const PictureSettings& settings,
                    const FilmHeader& header, const Console& console);

}  // namespace grove::app
