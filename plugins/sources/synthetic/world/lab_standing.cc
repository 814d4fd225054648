// People who stand still for longer than any background should wait.

#include <array>

#include "plugins/sources/synthetic/world/common_orders.h"
#include "plugins/sources/synthetic/world/scenarios.h"

namespace plaza::synthetic {
namespace {

/// Two stand where they are for more than a minute while the others walk about. Then they go on as
/// well and leave an empty floor behind.
class Standing final : public Scenario {
 public:
  void begin(Director& director) override { spread(director, 4, ClothingStyle::kAny); }

  void idle(Director& director, std::size_t who) override {
    if (who < 2 && !stood_[who]) {
      stood_[who] = true;
      director.stand(who, director.random().uniform(kLeastS, kMostS));
      return;
    }
    roam(director, who, 0.8, 1.3, 2.0);
  }

 private:
  // they appear two seconds before the clip
  static constexpr double kLeastS = 66, kMostS = 70;
  std::array<bool, 2> stood_ = {};
};

}  // namespace

std::unique_ptr<Scenario> make_standing(int /*people*/) { return std::make_unique<Standing>(); }

}  // namespace plaza::synthetic
