#include "modalities/color/shape_analysis.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

namespace plaza::color {
namespace {

constexpr double kBodyShare = 0.5;  ///< of a body's height, from which on a piece may have holes

/// Pixels [begin, end) of a row, all foreground or all background.
struct Run {
  int row = 0, begin = 0, end = 0;
  std::size_t parent = 0;  ///< another run of the same piece, itself at its first
};

/// A connected piece of foreground (8-neighbours) or background (4-neighbours).
struct Piece {
  int left = 0, right = 0, top = 0, bottom = 0;  ///< outermost pixels
  int area = 0;
  bool at_border = false;
};

/// First column from `x` on that differs from `value`, or `end`.
int run_end(const std::uint8_t* row, int x, int end, std::uint8_t value) {
  std::uint64_t eight = 0, same = 0;
  std::memset(&same, value, sizeof(same));
  for (; x + 8 <= end; x += 8) {
    std::memcpy(&eight, row + x, sizeof(eight));
    if (eight != same) break;
  }
  while (x < end && row[x] == value) ++x;
  return x;
}

/// The connected pieces of one kind of pixels.
class Pieces {
 public:
  Pieces(const cv::Mat& mask, bool set) : reach_(set ? 1 : 0) {
    std::size_t above = 0;  // first run of the row above
    for (int y = 0; y < mask.rows; ++y) {
      const std::size_t first = runs_.size();
      const auto* const row = mask.ptr<std::uint8_t>(y);
      for (int x = 0; x < mask.cols;) {
        const int end = run_end(row, x, mask.cols, row[x]);
        if ((row[x] != 0) == set) runs_.push_back({y, x, end, runs_.size()});
        x = end;
      }
      join(above, first);
      above = first;
    }
    pieces_.resize(runs_.size());
    for (std::size_t i = 0; i < runs_.size(); ++i) add(runs_[i], mask.size(), pieces_[find(i)]);
  }

  /// In the order of pixels.
  const std::vector<Run>& runs() const { return runs_; }
  const Piece& of(std::size_t run) { return pieces_[find(run)]; }
  /// The piece's first run.
  std::size_t find(std::size_t run) {
    while (runs_[run].parent != run) {
      runs_[run].parent = runs_[runs_[run].parent].parent;
      run = runs_[run].parent;
    }
    return run;
  }
  /// The run that ends right before a pixel; there must be one.
  std::size_t ending_at(int x, int row) const {
    const auto found = std::lower_bound(runs_.begin(), runs_.end(), std::pair(row, x),
                                        [](const Run& run, const std::pair<int, int>& place) {
                                          return std::pair(run.row, run.end) < place;
                                        });
    return static_cast<std::size_t>(found - runs_.begin());
  }

 private:
  /// Runs of the row from `first` on with those of the row above.
  void join(std::size_t above, std::size_t first) {
    for (std::size_t a = above, b = first; a < first && b < runs_.size();) {
      const Run &p = runs_[a], &q = runs_[b];
      if (p.begin < q.end + reach_ && q.begin < p.end + reach_) {
        const std::size_t i = find(a), j = find(b);
        runs_[std::max(i, j)].parent = std::min(i, j);
      }
      ++(p.end < q.end ? a : b);  // runs of one kind don't touch: no corner is passed over
    }
  }
  static void add(const Run& run, cv::Size image, Piece& piece) {
    if (piece.area == 0) piece = {run.begin, run.end - 1, run.row, run.row, 0, false};
    piece.left = std::min(piece.left, run.begin);
    piece.right = std::max(piece.right, run.end - 1);
    piece.bottom = run.row;
    piece.area += run.end - run.begin;
    piece.at_border = piece.at_border || run.begin == 0 || run.end == image.width || run.row == 0 ||
                      run.row == image.height - 1;
  }

  int reach_;  ///< 1: pixels that touch at a corner are neighbours
  std::vector<Run> runs_;
  std::vector<Piece> pieces_;  ///< by the piece's first run
};

/// Height of a thing from row `top` down to (x, bottom), in metres, at most; nothing where nobody
/// can be seen.
std::optional<double> height_m(const BodyScale& scale, int x, int top, int bottom) {
  const float px_per_m = scale.px_per_m(x, bottom);
  if (px_per_m == 0) return std::nullopt;
  return (bottom - top + 1) / static_cast<double>(px_per_m);
}

void paint(const Run& run, std::uint8_t value, cv::Mat& mask) {
  std::memset(mask.ptr<std::uint8_t>(run.row) + run.begin, value,
              static_cast<std::size_t>(run.end - run.begin));
}

/// Surrounded by people, and small enough to be a gap between somebody's limbs.
void fill_holes(const BodyScale& scale, double most_hole, cv::Mat& mask) {
  Pieces holes(mask, false), pieces(mask, true);
  for (std::size_t i = 0; i < holes.runs().size(); ++i) {
    const std::size_t first = holes.find(i);
    const Piece& hole = holes.of(i);
    if (hole.at_border) continue;
    // the outer border of a hole is of one piece
    const Run& begin = holes.runs()[first];
    const Piece& around = pieces.of(pieces.ending_at(begin.begin, begin.row));
    const int x = (around.left + around.right) / 2;
    const std::optional<double> height = height_m(scale, x, around.top, around.bottom);
    if (!height || *height < kBodyShare * scale.body_m()) continue;
    if (hole.area > most_hole * static_cast<double>(scale.box_px2(x, around.bottom))) continue;
    paint(holes.runs()[i], 255, mask);
  }
}

/// Row by row, with the row in which each column's run began: columns lie far apart in memory.
void drop_low_columns(const BodyScale& scale, double least_m, cv::Mat& mask) {
  std::vector<int> begins(static_cast<std::size_t>(mask.cols), -1);
  const auto end_run = [&](int x, int row) {
    int& begin = begins[static_cast<std::size_t>(x)];
    const std::optional<double> height = height_m(scale, x, begin, row - 1);
    if (height && *height < least_m) {
      for (int y = begin; y < row; ++y) mask.at<std::uint8_t>(y, x) = 0;
    }
    begin = -1;
  };
  const std::vector<std::uint8_t> nothing(static_cast<std::size_t>(mask.cols), 0);
  std::vector<std::uint8_t> before = nothing, here = nothing;
  for (int y = 0; y <= mask.rows; ++y) {
    const std::uint8_t* const now = y < mask.rows ? mask.ptr<std::uint8_t>(y) : nothing.data();
    here.assign(now, now + mask.cols);  // as it was: runs that end are taken out of the mask
    for (int x = 0; x < mask.cols; ++x) {
      const auto i = static_cast<std::size_t>(x);
      if (here[i] == before[i]) continue;
      if (here[i] != 0) {
        begins[i] = y;
      } else {
        end_run(x, y);
      }
    }
    before.swap(here);
  }
}

void drop_low_pieces(const BodyScale& scale, double least_m, cv::Mat& mask) {
  Pieces pieces(mask, true);
  for (std::size_t i = 0; i < pieces.runs().size(); ++i) {
    const Piece& piece = pieces.of(i);
    const std::optional<double> height =
        height_m(scale, (piece.left + piece.right) / 2, piece.top, piece.bottom);
    if (height && *height < least_m) paint(pieces.runs()[i], 0, mask);
  }
}

}  // namespace

cv::Mat analysed(const cv::Mat& mask, const BodyScale& scale, const ShapeOptions& options) {
  if (!options.any()) return mask;
  cv::Mat out = mask.clone();
  if (options.most_hole > 0) fill_holes(scale, options.most_hole, out);
  if (options.least_column_m > 0) drop_low_columns(scale, options.least_column_m, out);
  if (options.least_height_m > 0) drop_low_pieces(scale, options.least_height_m, out);
  return out;
}

}  // namespace plaza::color
