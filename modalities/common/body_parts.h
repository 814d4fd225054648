#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "plaza/component/models.h"
#include "plaza/geometry/camera.h"
#include "plaza/geometry/silhouette.h"

/// Part-based matching (thesis 7.2), as far as modalities share it: where a body's parts lie in an
/// image, and what is believed of a body any part of which may be hidden.
namespace plaza {

/// More parts make 2^n cases; the thesis's body has three.
inline constexpr std::size_t kMostBodyParts = 4;

/// A piece of the body between two heights, by which it is cut from the ground upwards.
struct BodyPart {
  double top = 1;     ///< height of its upper end, as a share of the body's, (0, 1]
  double hidden = 0;  ///< probability that something nobody described hides it, [0, 1)
};

/// Of a parameter "parts", [top, hidden] pairs; none: nobody asks for parts. Throws UserError where
/// tops don't rise to 1, where a probability isn't one or certain, or where parts are too many.
std::vector<BodyPart> read_body_parts(std::span<const std::vector<double>> pairs);

/// Where the parts of a standing body lie in an image: between lines across its axis, the pieces at
/// both ends reaching on without end. In a view in which the axis can't be seen as a whole (a body
/// at the camera's side, one that ends behind the lens's limits), all is the lowest part.
class BodyCuts {
 public:
  BodyCuts(std::span<const BodyPart> parts, const Body& body, const Pose& pose,
           const Camera& camera);

  std::size_t parts() const { return count_ + 1; }
  std::size_t part_of(double x, double y) const {
    const double height_px = up_.x() * x + up_.y() * y;
    std::size_t part = 0;
    while (part < count_ && height_px >= cuts_px_[part]) ++part;
    return part;
  }
  /// The spans of each part, in the order in which they come. Pixels are where their centres are.
  std::vector<std::vector<RowSpan>> split(std::span<const RowSpan> spans) const;

 private:
  Eigen::Vector2d up_ = Eigen::Vector2d::Zero();  ///< along the axis in the image, unit length
  std::array<double, kMostBodyParts - 1> cuts_px_ = {};  ///< rising, along `up`
  std::size_t count_ = 0;                                ///< of cuts
};

/// What a view says of a body, each of whose parts may be hidden on its own. Over the cases of what
/// is in sight, S a set of parts,
///     L = sum over S of P(S) L(S),    P(S) ~ prod in S (1 - hidden) * prod others (hidden),
/// L(S) being the likelihood of what is seen of S alone: what is hidden speaks neither for nor
/// against, as behind a described occluder. That nothing at all is in sight is no case, and P is
/// made to sum up to 1; so whatever all cases agree on stays as it is: an empty place is as
/// unlikely as without parts, and a body that is seen whole is as likely.
class PartMixture {
 public:
  explicit PartMixture(std::span<const BodyPart> parts);

  std::size_t parts() const { return parts_; }
  /// `telling` has bit k set where enough of part k is left to look at; at least one.
  /// `log_likelihood(S)`, bits likewise, is asked for S within `telling`.
  template <class LogLikelihood>
  double log_likelihood(unsigned telling, const LogLikelihood& log_likelihood) const;

 private:
  static constexpr std::size_t kCases = std::size_t{1} << kMostBodyParts;
  /// log of sum exp of `n` terms.
  static double log_sum(const double* terms, std::size_t n);

  std::size_t parts_;
  std::array<std::array<double, kCases>, kCases> log_prior_ = {};  ///< [telling][S]
};

template <class LogLikelihood>
double PartMixture::log_likelihood(unsigned telling, const LogLikelihood& log_likelihood) const {
  std::array<double, kCases> terms;
  std::size_t n = 0;
  for (unsigned in_sight = telling; in_sight != 0; in_sight = (in_sight - 1) & telling) {
    const double prior = log_prior_[telling][in_sight];
    if (prior == prior) terms[n++] = prior + log_likelihood(in_sight);
  }
  return log_sum(terms.data(), n);
}

}  // namespace plaza
