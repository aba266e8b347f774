#pragma once

#include <string>
#include <string_view>

#include "grove/render/saved/film_file.h"

namespace grove {

/// The header of a film file as it stands there.
[[nodiscard]] std::string film_header_json(const FilmHeader& header);

/// The other way. Throws InputError, naming `file`, for what is no header, or tells of a picture or a part that cannot be.
[[nodiscard]] FilmHeader film_header_from_json(std::string_view json, std::string_view file);

}  // namespace grove
