#include "modalities/color/part_occupancy.h"

#include <array>

namespace plaza::color {
namespace {

/// Pixels to look at, in parts together.
struct Seen {
  std::uint32_t inside = 0, set = 0;
  std::uint32_t ring = 0, ring_set = 0;

  void add(const Seen& other) {
    inside += other.inside;
    set += other.set;
    ring += other.ring;
    ring_set += other.ring_set;
  }
  double occupancy() const {
    const double share = static_cast<double>(set) / inside;
    return ring == 0 ? share : share - static_cast<double>(ring_set) / ring;
  }
};

}  // namespace

std::optional<double> log_likelihood_in_parts(const SpanTemplates& templates, std::size_t body,
                                              std::span<const TemplateCounts> counts,
                                              const PartJudgement& judgement) {
  const std::size_t first = body * templates.parts();
  std::array<Seen, kMostBodyParts> parts;
  unsigned telling = 0;
  bool empty = true;
  double left = 0, full = 0;
  for (std::size_t k = 0; k < templates.parts(); ++k) {
    const SpanTemplate& t = templates.at(first + k);
    const TemplateCounts& c = counts[k];
    left += t.inner_area - c.inner.hidden;
    full += t.full_area;
    if (!tells(t, c.inner, judgement.least_visible)) continue;
    telling |= 1U << k;
    empty = empty && c.outer.set == 0;
    parts[k] = {.inside = t.inner_area - c.inner.hidden,
                .set = c.inner.set,
                .ring = t.outer_area - t.near_area - (c.outer.hidden - c.near.hidden),
                .ring_set = c.outer.set - c.near.set};
  }
  if (telling == 0 || left < judgement.least_visible * full) return std::nullopt;
  if (empty) return judgement.scale;  // in every case
  return judgement.mixture.log_likelihood(telling, [&](unsigned in_sight) {
    Seen all;
    for (std::size_t k = 0; k < templates.parts(); ++k) {
      if ((in_sight >> k & 1U) != 0) all.add(parts[k]);
    }
    const double missing = 1 - all.occupancy();
    return judgement.scale * missing * missing;
  });
}

}  // namespace plaza::color
