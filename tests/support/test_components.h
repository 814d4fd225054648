#pragma once

#include "framework/plugin/registry.h"
#include "plaza/component/declaration.h"
#include "plaza/geometry/scene.h"

namespace plaza::test {

/// Small components of every kind, for tests of everything that reads declarations: ports, each
/// type of parameter, nested parts, checks and constructors that fail. They compute nothing.
///
///   sources      video (Frames), synthetic (Frames, GroundTruth), ground-truth (GroundTruth)
///   modalities   edges (Evidence), color (Evidence, ForegroundMask)
///   detectors    boxes (Frames), grid (inputs of Evidence, a shape), oracle (reads GroundTruth, as
///   it must not) describers   histogram (Frames, Observations) associators  gnn (Observations ->
///   Tracks, Tracklets; a motion), flow (Tracklets -> Tracks; affinities) parts        cylinder,
///   cuboid; constant-velocity; location, appearance, mixture (nested affinities) evaluators
///   scores; sinks report, faulty (constructor throws what is no plaza::Error); renderer overlay
void register_components(ComponentRegistrar& registrar);

/// A registry of them.
Registry make_registry();

/// A scene without cameras, enough for components that look at none.
std::shared_ptr<const Scene> make_scene();

}  // namespace plaza::test
