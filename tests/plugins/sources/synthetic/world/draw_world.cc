// Draws a scenario as contact sheets, to be looked at: ways from above, and stick figures from the
// side. Usage: draw_world SCENARIO SEED SECONDS OUT.png [PEOPLE]

#include <cstdlib>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "plugins/sources/synthetic/people/skeleton.h"
#include "plugins/sources/synthetic/world/world.h"

namespace plaza::synthetic {
namespace {

using Eigen::Vector3d;

/// An orthographic camera: what is ahead of it is drawn at `scale` pixels per metre.
struct View {
  Vector3d right, up;
  double scale = 60;
  cv::Point2d origin;
  cv::Point2d of(const Vector3d& p) const {
    return {origin.x + scale * right.dot(p), origin.y - scale * up.dot(p)};
  }
};

cv::Scalar color_of(std::size_t person) {
  static const cv::Scalar colors[] = {{40, 40, 220},  {200, 90, 20},  {30, 150, 30},
                                      {190, 30, 190}, {20, 140, 230}, {150, 150, 20},
                                      {90, 60, 120},  {0, 0, 0},      {100, 100, 255}};
  return colors[person % 9];
}

void draw_body(cv::Mat& image, const View& view, const PersonState& state, const Proportions& p) {
  const auto bone = [&](Segment s, const Vector3d& from, const Vector3d& to, int width) {
    const Eigen::Isometry3d& at = state.pose[s];
    cv::line(image, view.of(at * from) * 8, view.of(at * to) * 8, color_of(state.person), width,
             cv::LINE_AA, 3);
  };
  const Vector3d o = Vector3d::Zero();
  const double hip = p.hip_width_m / 2;
  bone(Segment::kPelvis, {0, -hip, 0}, {0, hip, 0}, 2);
  bone(Segment::kPelvis, o, {0, 0, p.pelvis_m}, 4);
  bone(Segment::kAbdomen, o, {0, 0, p.abdomen_m}, 4);
  bone(Segment::kChest, o, {0, 0, p.chest_m}, 4);
  bone(Segment::kChest, shoulder_offset(p, 1), shoulder_offset(p, -1), 2);
  bone(Segment::kNeck, o, {0, 0, p.neck_m}, 2);
  bone(Segment::kHead, o, {0, 0, p.head_m}, 5);
  bone(Segment::kHead, {0, 0, p.head_m / 2}, {0.14, 0, p.head_m / 2}, 1);
  for (int side = 0; side < 2; ++side) {
    const auto pick = [&](Segment left, Segment right) { return side == 0 ? left : right; };
    const int width = side == 0 ? 3 : 1;  // the left side is drawn bolder
    bone(pick(Segment::kLeftUpperArm, Segment::kRightUpperArm), o, {0, 0, -p.upper_arm_m}, width);
    bone(pick(Segment::kLeftForearm, Segment::kRightForearm), o, {0, 0, -p.forearm_m}, width);
    bone(pick(Segment::kLeftHand, Segment::kRightHand), o, {0, 0, -p.hand_m}, 1);
    bone(pick(Segment::kLeftThigh, Segment::kRightThigh), o, {0, 0, -p.thigh_m}, width);
    bone(pick(Segment::kLeftShin, Segment::kRightShin), o, {0, 0, -p.shin_m}, width);
    const Segment foot = pick(Segment::kLeftFoot, Segment::kRightFoot);
    bone(foot, o, {kHeelShare * p.foot_m, 0, -p.ankle_m}, width);
    bone(foot, {kHeelShare * p.foot_m, 0, -p.ankle_m}, {kToeShare * p.foot_m, 0, -p.ankle_m},
         width);
  }
}

/// All that happens between two moments, from above.
cv::Mat draw_ways(const World& world, double from_s, double to_s) {
  const Rectangle frame =
      (world.stage().walls ? *world.stage().walls : world.stage().area).grown(1);
  View view{Vector3d::UnitX(), Vector3d::UnitY(), 420 / frame.size().maxCoeff(), {}};
  const cv::Size size(static_cast<int>(frame.size().x() * view.scale),
                      static_cast<int>(frame.size().y() * view.scale));
  view.origin = {-frame.low.x() * view.scale, frame.high.y() * view.scale};
  cv::Mat image(size, CV_8UC3, cv::Scalar(255, 255, 255));
  const auto box = [&](const Rectangle& r, const cv::Scalar& color, int width) {
    cv::rectangle(image, view.of({r.low.x(), r.low.y(), 0}), view.of({r.high.x(), r.high.y(), 0}),
                  color, width);
  };
  for (const Furniture& thing : world.stage().furniture) {
    box(thing.footprint, {200, 200, 200}, cv::FILLED);
  }
  box(world.stage().area, {180, 180, 180}, 1);
  if (world.stage().walls) {
    box(*world.stage().walls, {0, 0, 0}, 2);
  }
  for (double t = from_s; t < to_s; t += 0.04) {
    for (const PersonState& s : world.at(t)) {
      cv::circle(image, view.of({s.position_m.x(), s.position_m.y(), 0}), 1, color_of(s.person),
                 cv::FILLED);
    }
  }
  for (const PersonState& s : world.at((from_s + to_s) / 2)) {
    draw_body(image, view, s, world.cast()[s.person].proportions);
  }
  cv::putText(image, std::to_string(from_s).substr(0, 4) + " s", {6, 16}, cv::FONT_HERSHEY_SIMPLEX,
              0.45, {0, 0, 0}, 1, cv::LINE_AA);
  return image;
}

/// Everyone at one moment from the side, a little from above.
cv::Mat draw_side(const World& world, double t, int width) {
  const Rectangle& area = world.stage().area;
  View view{Vector3d::UnitX(), Vector3d(0, 0.35, 0.94), 100, {}};
  view.scale = (width - 20) / (area.size().x() + 1);
  view.origin = {width / 2.0 - view.scale * area.center().x(),
                 view.scale * (2.2 + 0.35 * (area.high.y()))};
  cv::Mat image(static_cast<int>(view.scale * (2.5 + 0.35 * area.size().y())), width, CV_8UC3,
                cv::Scalar(250, 250, 250));
  for (const PersonState& s : world.at(t)) {
    draw_body(image, view, s, world.cast()[s.person].proportions);
  }
  cv::putText(image, std::to_string(t).substr(0, 5) + " s", {6, 16}, cv::FONT_HERSHEY_SIMPLEX, 0.45,
              {0, 0, 0}, 1, cv::LINE_AA);
  return image;
}

/// The first person in a strip, every 0.08 s, seen from its right: how a walk looks.
cv::Mat draw_strip(const World& world, std::size_t person, double from_s) {
  cv::Mat image(300, 1600, CV_8UC3, cv::Scalar(255, 255, 255));
  for (int k = 0; k < 16; ++k) {
    for (const PersonState& s : world.at(from_s + 0.08 * k)) {
      if (s.person != person) {
        continue;
      }
      const Vector3d ahead(std::cos(s.heading_rad), std::sin(s.heading_rad), 0);
      View view{ahead, Vector3d::UnitZ(), 130, {}};
      const Vector3d at(s.position_m.x(), s.position_m.y(), 0);
      view.origin = {55.0 + 100 * k - view.scale * ahead.dot(at), 280};
      draw_body(image, view, s, world.cast()[person].proportions);
    }
  }
  cv::line(image, {0, 280}, {1600, 280}, {150, 150, 150});
  return image;
}

int draw(int argc, char** argv) {
  if (argc < 5) {
    std::cerr << "draw_world SCENARIO SEED SECONDS OUT.png [PEOPLE]\n";
    return 2;
  }
  WorldOptions options;
  options.scenario = argv[1];
  options.seed = std::strtoull(argv[2], nullptr, 10);
  options.duration_s = std::atof(argv[3]);
  if (argc > 5) {
    options.people = std::atoi(argv[5]);
  }
  for (const ScenarioInfo& info : World::scenarios()) {
    if (info.name == options.scenario) {
      options.stage = info.indoor ? indoor_stage({{-2, -3}, {2, 3}})
                                  : outdoor_stage({{-0.5, -1.5}, {7.0, 9.5}});
    }
  }
  const World world(options);
  cv::Mat sheet;
  std::vector<cv::Mat> rows;
  for (int row = 0; row < 2; ++row) {
    std::vector<cv::Mat> views;
    for (int k = 0; k < 4; ++k) {
      const double from = options.duration_s * (row * 4 + k) / 8;
      views.push_back(draw_ways(world, from, from + options.duration_s / 8));
    }
    cv::hconcat(views, rows.emplace_back());
  }
  for (int row = 0; row < 3; ++row) {
    std::vector<cv::Mat> views;
    const int width = rows[0].cols / 3;
    for (int k = 0; k < 3; ++k) {
      views.push_back(draw_side(world, options.duration_s * (row * 3 + k + 0.5) / 9,
                                k == 2 ? rows[0].cols - 2 * width : width));
    }
    const int height = std::min({views[0].rows, views[1].rows, views[2].rows});
    for (cv::Mat& view : views) {
      view = view.rowRange(0, height);
    }
    cv::hconcat(views, rows.emplace_back());
  }
  for (const double from : {0.25, 0.5}) {
    cv::Mat strip = draw_strip(world, from < 0.4 ? 0 : 1, from * options.duration_s);
    cv::resize(strip, rows.emplace_back(), {rows[0].cols, 300 * rows[0].cols / 1600});
  }
  cv::vconcat(rows, sheet);
  return cv::imwrite(argv[4], sheet) ? 0 : 1;
}

}  // namespace
}  // namespace plaza::synthetic

int main(int argc, char** argv) { return plaza::synthetic::draw(argc, argv); }
