#include <cmath>

#include "stage.h"

namespace plaza::contract {
namespace {

std::vector<Pose> poses() {
  std::vector<Pose> out;
  for (const double x : {-4.0, 0.0, 3.0}) {
    for (const double y : {-3.0, 1.0}) {
      for (const double heading : {0.0, 2.0}) out.push_back({{x, y}, heading, 1.0});
    }
  }
  return out;
}

bool same(const Silhouette& a, const Silhouette& b) {
  if (a.contour.size() != b.contour.size() || a.spans.size() != b.spans.size() ||
      !(a.box == b.box) || a.inside_share != b.inside_share) {
    return false;
  }
  for (std::size_t i = 0; i < a.contour.size(); ++i) {
    if (a.contour[i].pixel != b.contour[i].pixel || a.contour[i].normal != b.contour[i].normal)
      return false;
  }
  for (std::size_t i = 0; i < a.spans.size(); ++i) {
    const RowSpan &s = a.spans[i], &t = b.spans[i];
    if (s.row != t.row || s.begin != t.begin || s.end != t.end) return false;
  }
  return true;
}

void check_silhouette(const Silhouette& s, const Camera& camera, Findings& findings) {
  findings.require(s.inside_share >= 0 && s.inside_share <= 1, "inside_share is not in [0, 1]");
  for (const ContourPoint& p : s.contour) {
    findings.require(p.pixel.allFinite(), "a contour point is not finite");
    findings.require(std::abs(p.normal.norm() - 1) < 1e-3, "a contour normal has not length 1");
  }
  std::int32_t row = -1, end = 0;
  for (const RowSpan& span : s.spans) {
    findings.require(span.row >= 0 && span.row < camera.height() && span.begin >= 0 &&
                         span.end <= camera.width(),
                     "a span lies outside the image");
    findings.require(span.begin < span.end, "a span is empty");
    findings.require(span.row > row || (span.row == row && span.begin >= end),
                     "spans are not by rising row, or overlap");
    row = span.row;
    end = span.end;
    findings.require(span.row + 1 >= s.box.top && span.row - 1 <= s.box.bottom(),
                     "a span lies above or below the box");
  }
}

}  // namespace

void check_shape(const Stage& stage, Findings& findings) {
  const auto model = stage.make_as<ShapeModel>();
  const auto second = stage.make_as<ShapeModel>();
  const Body body = model->body();
  findings.require(body.height_m > 0 && body.radius_m > 0, "body() has no size");
  bool seen = false;
  for (const Camera& camera : stage.scene().cameras) {
    for (const Pose& pose : poses()) {
      const Silhouette s = model->silhouette(pose, camera);
      seen = seen || !s.spans.empty();
      check_silhouette(s, camera, findings);
      findings.require(
          same(s, model->silhouette(pose, camera)) && same(s, second->silhouette(pose, camera)),
          "the same pose gives another silhouette");
      Pose larger = pose;
      larger.scale = 1.5;
      const Silhouette l = model->silhouette(larger, camera);
      check_silhouette(l, camera, findings);
      if (!s.spans.empty() && !l.spans.empty()) {
        findings.require(l.box.height > s.box.height, "a larger scale gives no taller silhouette");
      }
    }
    // behind the camera, and right below it
    const Eigen::Vector2d foot = camera.centre().head<2>();
    const Silhouette behind = model->silhouette({3 * foot, 0, 1}, camera);
    findings.require(behind.contour.empty() && behind.spans.empty(),
                     "a person behind the camera has a silhouette");
    findings.step("a person below the camera", [&] {
      check_silhouette(model->silhouette({foot, 0, 1}, camera), camera, findings);
    });
  }
  findings.require(seen, "nobody in the middle of the area is seen by any camera");
}

void check_appearance(const Stage& stage, Findings& findings) {
  const auto model = stage.make_as<AppearanceModel>();
  for (const Camera& camera : stage.scene().cameras) {
    for (const Pose& pose : poses()) {
      const std::vector<SurfacePoint> points = model->visible_points(pose, camera);
      const std::vector<SurfacePoint> again = model->visible_points(pose, camera);
      findings.require(points.size() == again.size(), "the same pose gives other points");
      for (std::size_t i = 0; i < points.size(); ++i) {
        const SurfacePoint& p = points[i];
        findings.require(p.position_m.allFinite() && p.lab.allFinite(),
                         "a surface point is not finite");
        findings.require(std::abs(p.normal.norm() - 1) < 1e-3, "a surface normal has not length 1");
        findings.require(
            i >= again.size() || (again[i].position_m == p.position_m && again[i].lab == p.lab),
            "the same pose gives other points");
      }
    }
  }
}

}  // namespace plaza::contract
