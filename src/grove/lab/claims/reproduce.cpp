#include "grove/lab/claims/reproduce.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "grove/base/error.h"
#include "grove/base/timer.h"
#include "grove/lab/utc_date.h"

namespace grove {
namespace {

bool is_chosen(const ReproduceSettings& settings, std::string_view id) {
  return settings.only.empty() || std::ranges::find(settings.only, id) != settings.only.end();
}

void check_ids(const ReproduceSettings& settings) {
  for (const std::string& id : settings.only) {
    if (std::ranges::find(review_claims(), id, &Claim::id) != review_claims().end()) continue;
    std::string known;
    for (const Claim& claim : review_claims()) {
      if (!known.empty()) known += ", ";
      known += claim.id;
    }
    throw UsageError(fmt::format("no claim is called '{}'; the claims are {}", id, known));
  }
}

/// Nothing where the experiment was stopped.
std::optional<CheckedClaim> check(const Claim& claim, const Effort& effort) {
  CheckedClaim checked{
      std::string(claim.id), std::string(claim.statement), std::string(claim.source), std::string(claim.method), {}, "", 0.0};
  const Timer timer;
  try {
    checked.finding = claim.check(effort);
  } catch (const Stopped&) {
    return std::nullopt;
  } catch (const std::bad_alloc&) {
    checked.error = "out of memory";
  } catch (const std::exception& error) {
    checked.error = error.what();
  }
  checked.seconds = timer.seconds();
  return checked;
}

}  // namespace

bool can_resume(const Reproduction& earlier, const ReproduceSettings& settings) {
  const Machine machine = describe_machine();
  return !earlier.claims.empty() && earlier.quick == settings.quick && earlier.machine.cpu == machine.cpu &&
         earlier.machine.threads == machine.threads && earlier.machine.compiler == machine.compiler &&
         earlier.machine.commit == machine.commit;
}

Reproduction reproduce(const ReproduceSettings& settings, const Reproduction& earlier, const ReproduceObserver& observer,
                       const std::stop_token& stop) {
  check_ids(settings);
  Reproduction result;
  result.machine = describe_machine();
  result.quick = settings.quick;
  result.command = settings.command;
  const bool resumes = can_resume(earlier, settings);
  const auto total =
      static_cast<std::size_t>(std::ranges::count_if(review_claims(), [&](const Claim& claim) { return is_chosen(settings, claim.id); }));
  for (const Claim& claim : review_claims()) {
    if (!is_chosen(settings, claim.id)) continue;
    const auto known = std::ranges::find(earlier.claims, claim.id, &CheckedClaim::id);
    if (resumes && known != earlier.claims.end() && known->finding) {
      result.claims.push_back(*known);
      result.date = earlier.date;
    } else {
      if (stop.stop_requested()) return result;
      if (observer.starts) observer.starts(claim, result.claims.size() + 1, total);
      std::optional<CheckedClaim> checked = check(claim, {settings.quick, stop});
      if (!checked) return result;
      result.claims.push_back(*std::move(checked));
      result.date = utc_date();
    }
    result.seconds += result.claims.back().seconds;
    result.is_complete = result.claims.size() == total;
    if (observer.finished) observer.finished(result);
  }
  return result;
}

}  // namespace grove
