#include "modalities/common/body_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "plaza/core/error.h"

namespace plaza {
std::vector<BodyPart> read_body_parts(std::span<const std::vector<double>> pairs) {
  if (pairs.size() > kMostBodyParts) {
    throw UserError(fault_at("/parts", "at most " + std::to_string(kMostBodyParts) + " parts"));
  }
  std::vector<BodyPart> parts;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::string pointer = "/parts/" + std::to_string(i);
    if (pairs[i].size() != 2) {
      throw UserError(fault_at(
          pointer, "a part is [upper end as a share of the height, probability to be hidden]"));
    }
    const BodyPart part{.top = pairs[i][0], .hidden = pairs[i][1]};
    if (!(part.top > (i > 0 ? parts.back().top : 0) && part.top <= 1)) {
      throw UserError(
          fault_at(pointer, "upper ends rise from the lowest part to the uppermost, up to 1"));
    }
    if (!(part.hidden >= 0 && part.hidden < 1)) {
      throw UserError(
          fault_at(pointer, "the probability to be hidden must be at least 0 and below 1"));
    }
    parts.push_back(part);
  }
  if (!parts.empty() && parts.back().top != 1) {
    throw UserError(
        fault_at("/parts/" + std::to_string(parts.size() - 1), "the uppermost part ends at 1"));
  }
  return parts;
}

BodyCuts::BodyCuts(std::span<const BodyPart> parts, const Body& body, const Pose& pose,
                   const Camera& camera) {
  const auto seen = [&](double share) {
    return camera.project(
        {pose.position_m.x(), pose.position_m.y(), share * body.height_m * pose.scale});
  };
  const std::optional<Eigen::Vector2d> foot = seen(0), crown = seen(1);
  if (parts.empty()) return;
  count_ = parts.size() - 1;
  std::fill_n(cuts_px_.begin(), count_, std::numeric_limits<double>::infinity());
  if (!foot || !crown || !((*crown - *foot).norm() > 1e-6)) return;
  std::array<double, kMostBodyParts - 1> cuts = {};
  const Eigen::Vector2d up = (*crown - *foot).normalized();
  for (std::size_t i = 0; i < count_; ++i) {
    const std::optional<Eigen::Vector2d> at = seen(parts[i].top);
    if (!at) return;
    cuts[i] = up.dot(*at);
  }
  up_ = up;
  cuts_px_ = cuts;
}

std::vector<std::vector<RowSpan>> BodyCuts::split(std::span<const RowSpan> spans) const {
  std::vector<std::vector<RowSpan>> out(parts());
  for (const RowSpan& span : spans) {
    // along a row the part rises or falls, so that each is one piece
    std::int32_t begin = span.begin;
    while (begin < span.end) {
      const std::size_t part = part_of(begin, span.row);
      std::int32_t known = begin, end = span.end;  // [begin, known] is of the part
      while (end - known > 1) {
        const std::int32_t middle = known + (end - known) / 2;
        (part_of(middle, span.row) == part ? known : end) = middle;
      }
      out[part].push_back({span.row, begin, end});
      begin = end;
    }
  }
  return out;
}

PartMixture::PartMixture(std::span<const BodyPart> parts) : parts_(parts.size()) {
  for (unsigned telling = 1; telling < (1U << parts_); ++telling) {
    double all = 0;
    std::array<double, kCases> prior = {};
    for (unsigned in_sight = telling; in_sight != 0; in_sight = (in_sight - 1) & telling) {
      prior[in_sight] = 1;
      for (std::size_t k = 0; k < parts_; ++k) {
        if ((telling >> k & 1U) == 0) continue;
        prior[in_sight] *= (in_sight >> k & 1U) != 0 ? 1 - parts[k].hidden : parts[k].hidden;
      }
      all += prior[in_sight];
    }
    for (unsigned s = 1; s < kCases; ++s) {
      log_prior_[telling][s] =
          prior[s] > 0 ? std::log(prior[s] / all) : std::numeric_limits<double>::quiet_NaN();
    }
  }
}

double PartMixture::log_sum(const double* terms, std::size_t n) {
  const double largest = *std::max_element(terms, terms + n);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += std::exp(terms[i] - largest);
  return largest + std::log(sum);
}

}  // namespace plaza
