#pragma once

#include "framework/plugin/registry.h"
#include "plaza/component/declaration.h"
#include "plaza/geometry/scene.h"

namespace plaza::test {

/// Small components of every kind, for tests of everything that reads declarations: ports, each
/// type of parameter, nested parts, checks and constructors that fail. They compute nothing.
///
/// - sources: video (Frames), synthetic (Frames, GroundTruth), ground-truth (GroundTruth)
/// - modalities: edges (Evidence), color (Evidence, ForegroundMask)
/// - detectors: boxes (Frames), grid (a list of Evidence, a shape), oracle (GroundTruth, against
///   the rules)
/// - a describer: histogram (Frames, Observations)
/// - associators: gnn (Observations to Tracks and Tracklets; a motion), flow (Tracklets to Tracks;
///   affinities)
/// - parts: shapes cylinder and cuboid; the motion constant-velocity; the affinities location,
///   appearance and mixture (of nested affinities)
/// - an evaluator scores, the sinks report and faulty (its constructor throws what is no
///   plaza::Error), a renderer overlay
void register_components(ComponentRegistrar& registrar);

/// A registry of them.
Registry make_registry();

/// A scene without cameras, enough for components that look at none.
std::shared_ptr<const Scene> make_scene();

}  // namespace plaza::test
