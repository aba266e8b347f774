#include "checkpoint.h"

#include <fmt/format.h>

#include <utility>

#include "grove/base/error.h"
#include "grove/base/output_file.h"
#include "picture_files.h"

namespace grove::app {
namespace {

/// What keeps a render from going on from a film; empty when nothing does.
std::string obstacle(const FilmHeader& there, const FilmHeader& here) {
  if (std::string text = difference(there.picture, here.picture); !text.empty()) return text;
  const PicturePart& old_part = there.part;
  const PicturePart& part = here.part;
  // More samples may be asked for than before.
  const bool continues = old_part.share == part.share && old_part.share_count == part.share_count &&
                         old_part.first_sample == part.first_sample && old_part.end_sample <= part.end_sample;
  return continues ? std::string() : fmt::format("{} instead of {}", old_part.text(), part.text());
}

}  // namespace

Checkpoint::Checkpoint(std::filesystem::path path, bool restarts, double interval_seconds)
    : path_(std::move(path)), interval_seconds_(interval_seconds) {
  if (!is_on()) return;
  check_writable(path_);
  if (restarts || !std::filesystem::exists(path_)) return;
  try {
    earlier_ = read_film(path_);
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + "; name another --checkpoint, or replace it with --restart");
  }
}

RenderCheckpoints Checkpoint::begin(const FilmHeader& header, const Console& console) {
  RenderCheckpoints checkpoints;
  if (!is_on()) return checkpoints;
  header_ = header;
  checkpoints.interval_seconds = interval_seconds_;
  checkpoints.save = [this, &console](const RenderResult& result) {
    try {
      write_film(with_result(header_, result), result.film, path_);
    } catch (const OutputError& error) {
      console.warn(fmt::format("{}; trying again in {:g} s", error.what(), interval_seconds_));
    }
  };
  if (!earlier_) return checkpoints;
  if (const std::string text = obstacle(earlier_->header, header); !text.empty()) {
    throw UsageError(fmt::format("{}: is the checkpoint of another render ({}); name another --checkpoint, or replace it with --restart",
                                 path_.string(), text));
  }
  console.say(fmt::format("checkpoint goes on from {}", path_.string()));
  RenderResult& result = checkpoints.earlier.emplace();
  result.film = std::move(earlier_->film);
  result.rays_traced = earlier_->header.rays_traced;
  result.seconds = earlier_->header.seconds;
  earlier_.reset();
  return checkpoints;
}

void Checkpoint::finish(const RenderResult& result, const Console& console) {
  if (!is_on()) return;
  try {
    console.status("saving " + path_.string());
    write_film(with_result(header_, result), result.film, path_);
    console.say("saved      " + path_.string());
  } catch (const OutputError&) {
    failure_ = std::current_exception();
  }
}

void Checkpoint::rethrow_failure() const {
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace grove::app
