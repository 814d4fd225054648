#include "plugins/detectors/hierarchical-grid/template_hierarchy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "models/cylinder/cylinder.h"
#include "plaza/core/error.h"
#include "plugins/detectors/hierarchical-grid/silhouette_codec.h"
#include "tests/plugins/detectors/simulated_scene.h"

namespace plaza {
namespace {

struct Place {
  std::shared_ptr<Scene> scene = testing::round_scene(2);
  StateGrid grid{scene->area, 8, 2, 2};
  Cylinder shape{{}, BuildContext{}};
  TemplateHierarchy hierarchy{grid, *scene};
};

void expect_near(const Silhouette& a, const Silhouette& b) {
  EXPECT_EQ(a.spans, b.spans);
  EXPECT_EQ(a.box, b.box);
  EXPECT_EQ(a.inside_share, b.inside_share);
  ASSERT_EQ(a.contour.size(), b.contour.size());
  for (std::size_t i = 0; i < a.contour.size(); ++i) {
    EXPECT_LE((a.contour[i].pixel - b.contour[i].pixel).norm(), 0.02);
    EXPECT_LE((a.contour[i].normal - b.contour[i].normal).norm(), 1e-3);
  }
}

TEST(SilhouetteCodec, KeepsWhatMatters) {
  const Place s;
  std::string bytes;
  std::vector<Silhouette> originals;
  for (const double x : {-3.0, 0.5, 40.0}) {  // the last one is out of sight
    originals.push_back(s.shape.silhouette({{x, 1}, 0, 1}, s.scene->cameras[0]));
    encode(originals.back(), bytes);
  }
  EXPECT_TRUE(originals[2].contour.empty());
  std::size_t at = 0;
  for (const Silhouette& original : originals) expect_near(original, decode(bytes, at));
  EXPECT_EQ(at, bytes.size());
  EXPECT_LT(bytes.size(), 8 * (originals[0].contour.size() + originals[1].contour.size()) + 1000);
}

TEST(SilhouetteCodec, RefusesBytesThatAreNoSilhouette) {
  const Place s;
  std::string bytes;
  encode(s.shape.silhouette({}, s.scene->cameras[0]), bytes);
  for (std::size_t length = 0; length < bytes.size(); length += 7) {
    std::size_t at = 0;
    EXPECT_THROW(decode(std::string_view(bytes).substr(0, length), at), Error) << length;
  }
  std::size_t at = 0;
  EXPECT_THROW(decode(std::string(60, '\xff'), at), Error);
}

TEST(TemplateHierarchy, HoldsTheModelWhereverItIsSeen) {
  Place s;
  s.hierarchy.compute(s.shape, 0.9, true);
  for (std::size_t camera = 0; camera < 2; ++camera) {
    for (std::size_t level = 0; level < 2; ++level) {
      const LevelTemplates& t = s.hierarchy.templates(camera, level);
      std::size_t next = 0;
      for (CellIndex cell = 0; cell < s.grid.size(level); ++cell) {
        const Silhouette model =
            s.shape.silhouette({s.grid.position(level, cell), 0, 1}, s.scene->cameras[camera]);
        const bool visible = model.inside_share >= 0.9;
        const bool stored = next < t.cells.size() && t.cells[next] == cell;
        ASSERT_EQ(visible, stored) << "camera " << camera << ", cell " << cell;
        if (!stored) continue;
        std::size_t at = t.offsets[next++];
        expect_near(model, decode(t.bytes, at));
      }
      EXPECT_GT(next, 0U);
    }
  }
}

TEST(TemplateHierarchy, IsTheSameAfterSavingAndLoading) {
  Place s, other;
  s.hierarchy.compute(s.shape, 0.3, true);
  std::stringstream file;
  s.hierarchy.save(file);
  other.hierarchy.load(file);
  for (std::size_t level = 0; level < 2; ++level) {
    const LevelTemplates &a = s.hierarchy.templates(1, level),
                         &b = other.hierarchy.templates(1, level);
    EXPECT_EQ(a.cells, b.cells);
    EXPECT_EQ(a.offsets, b.offsets);
    EXPECT_EQ(a.bytes, b.bytes);
  }
}

TEST(TemplateHierarchy, RefusesAnyDamage) {
  Place s;
  s.hierarchy.compute(s.shape, 0.3, true);
  std::ostringstream file;
  s.hierarchy.save(file);
  const std::string good = file.str();
  const auto load = [&](const std::string& bytes) {
    Place fresh;
    std::istringstream in(bytes);
    fresh.hierarchy.load(in);
  };
  EXPECT_NO_THROW(load(good));
  for (std::size_t length = 0; length < good.size(); length += good.size() / 40) {
    EXPECT_THROW(load(good.substr(0, length)), Error) << length;
  }
  EXPECT_THROW(load(good + "x"), Error);
  EXPECT_THROW(load("some other file, long enough to hold all that is asked for"), Error);
  std::string cell = good;
  cell[27 + 16 + 8] = '\x7f';  // the first cell's number
  EXPECT_THROW(load(cell), Error);
  std::string length = good;
  length[27 + 16 + 5] = '\x7f';  // the count of cells
  EXPECT_THROW(load(length), Error);
  // another grid
  Place small;
  StateGrid grid(small.scene->area, 4, 2, 2);
  TemplateHierarchy hierarchy(grid, *small.scene);
  std::istringstream in(good);
  EXPECT_THROW(hierarchy.load(in), Error);
}

TEST(StoredShape, ServesWhatIsStoredAndAsksForTheRest) {
  Place s;
  s.hierarchy.compute(s.shape, 0.3, true);
  const Camera& camera = s.scene->cameras[0];
  const LevelTemplates& t = s.hierarchy.templates(0, 1);
  const StoredShape stored(s.shape, s.grid, {1, 1}, t);
  std::size_t at = t.offsets[5];
  const Silhouette fifth = decode(t.bytes, at);
  const Pose pose{s.grid.position(1, t.cells[5]), 0, 1};
  EXPECT_EQ(stored.silhouette(pose, camera).contour[3].pixel, fifth.contour[3].pixel);
  for (const Pose& other :
       {Pose{pose.position_m + Eigen::Vector2d(0.01, 0), 0, 1}, Pose{pose.position_m, 0, 1.1}}) {
    const Silhouette direct = s.shape.silhouette(other, camera);
    EXPECT_EQ(stored.silhouette(other, camera).contour.at(3).pixel, direct.contour.at(3).pixel);
  }
}

TEST(TemplateHierarchy, HoldsOtherSizesOnTheFinestLevel) {
  Place s;
  const double sizes[] = {0.9};
  TemplateHierarchy all(s.grid, *s.scene, sizes), loaded(s.grid, *s.scene, sizes);
  all.compute(s.shape, 0.9, true);
  ASSERT_EQ(all.layers().size(), 3U);
  EXPECT_EQ(all.layers()[2].level, 1U);
  EXPECT_EQ(all.layers()[2].scale, 0.9);
  std::stringstream file;
  all.save(file);
  loaded.load(file);
  for (const TemplateHierarchy* hierarchy : {&all, &loaded}) {
    const LevelTemplates& t = hierarchy->templates(0, 2);
    const StoredShape stored(s.shape, s.grid, hierarchy->layers()[2], t);
    ASSERT_FALSE(t.cells.empty());
    for (const CellIndex cell : t.cells) {
      const Pose pose{s.grid.position(1, cell), 0, 0.9};
      expect_near(s.shape.silhouette(pose, s.scene->cameras[0]),
                  stored.silhouette(pose, s.scene->cameras[0]));
    }
  }
  TemplateHierarchy without(s.grid, *s.scene);
  file.clear();
  file.seekg(0);
  EXPECT_THROW(without.load(file), Error) << "stored with another number of sizes";
}

}  // namespace
}  // namespace plaza
