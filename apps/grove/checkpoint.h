#pragma once

#include <exception>
#include <filesystem>
#include <optional>

#include "console.h"
#include "grove/render/render.h"
#include "grove/render/saved/film_file.h"

namespace grove::app {

/// The file in which a render is saved and from which the same command goes on.
class Checkpoint {
 public:
  /// An empty path turns it off. Reads what is there, unless it is to be replaced, so that a file that cannot be used is found before the scene
  /// is read. Throws InputError for such a file, OutputError for one that cannot be written.
  Checkpoint(std::filesystem::path path, bool restarts, double interval_seconds);

  [[nodiscard]] bool is_on() const { return !path_.empty(); }

  /// What `render` needs; this object and `console` must outlive it. Throws UsageError when the file is of another picture or part than the header.
  /// Saving that fails on the way is a warning, and tried again at the next interval.
  [[nodiscard]] RenderCheckpoints begin(const FilmHeader& header, const Console& console);

  /// Saves the result. What goes wrong is kept, for the picture is still to be written.
  void finish(const RenderResult& result, const Console& console);
  void rethrow_failure() const;

 private:
  std::filesystem::path path_;
  double interval_seconds_;
  std::optional<SavedFilm> earlier_;
  FilmHeader header_;
  std::exception_ptr failure_;
};

}  // namespace grove::app
