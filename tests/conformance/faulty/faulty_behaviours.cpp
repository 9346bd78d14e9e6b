// Behaviours and controllers that break their contracts.
#include "tests/conformance/behaviour.hpp"
#include "tests/conformance/controller.hpp"
#include "tests/conformance/faulty/faulty_modules.hpp"

namespace cairn::conformance {
namespace {

class WrappedBehaviour : public Behaviour {
 public:
  explicit WrappedBehaviour(std::shared_ptr<Behaviour> inner) : inner_(std::move(inner)) {}
  Status tick(const WorldView& world, BehaviourContext& context) override { return inner_->tick(world, context); }
  void halt() override { inner_->halt(); }

 protected:
  std::shared_ptr<Behaviour> inner_;
};

class LateBehaviour : public WrappedBehaviour {
 public:
  using WrappedBehaviour::WrappedBehaviour;
  Status tick(const WorldView& world, BehaviourContext& context) override {
    context_ = &context;
    return inner_->tick(world, context);
  }
  void halt() override {
    if (context_ != nullptr) context_->drive(Twist{});
    inner_->halt();
  }

 private:
  BehaviourContext* context_ = nullptr;
};

class ForgetfulBehaviour : public WrappedBehaviour {
 public:
  using WrappedBehaviour::WrappedBehaviour;
  void halt() override {}
};

class NanBehaviour : public WrappedBehaviour {
 public:
  using WrappedBehaviour::WrappedBehaviour;
  Status tick(const WorldView& world, BehaviourContext& context) override {
    context.drive({0.0 * kInfinity, 0.0});
    return inner_->tick(world, context);
  }
};

Subject<Behaviour> shipped_drive() {
  return module<Behaviour>(kModules, "drive", "{points_m: [[1.5, 1], [1.5, 4]]}");
}
INSTANTIATE_TEST_SUITE_P(Faulty, BehaviourConformance,
                         testing::Values(wrapped<Behaviour, LateBehaviour>("drives in halt", shipped_drive()),
                                         wrapped<Behaviour, ForgetfulBehaviour>("halts not", shipped_drive()),
                                         wrapped<Behaviour, NanBehaviour>("orders NaN", shipped_drive())));

class WrappedController : public Controller {
 public:
  explicit WrappedController(std::shared_ptr<Controller> inner) : inner_(std::move(inner)) {}
  ControlResult control(const ControlRequest& request, const WorldView& world) override {
    return inner_->control(request, world);
  }

 protected:
  std::shared_ptr<Controller> inner_;
};

class BlindController : public WrappedController {
 public:
  using WrappedController::WrappedController;
  ControlResult control(const ControlRequest& request, const WorldView& world) override {
    ControlRequest blind = request;
    blind.obstacles = {};
    return inner_->control(blind, world);
  }
};

// Follows the first path for ever.
class StubbornController : public WrappedController {
 public:
  using WrappedController::WrappedController;
  ControlResult control(const ControlRequest& request, const WorldView& world) override {
    if (path_.empty()) path_.assign(request.path.begin(), request.path.end());
    ControlRequest first = request;
    if (!request.path.empty()) first.path = path_;
    return inner_->control(first, world);
  }

 private:
  std::vector<Point> path_;
};

class HastyController : public WrappedController {
 public:
  using WrappedController::WrappedController;
  ControlResult control(const ControlRequest& request, const WorldView& world) override {
    ControlResult result = inner_->control(request, world);
    result.twist.v_mps *= 3.0;
    return result;
  }
};

std::vector<Subject<Controller>> faulty_controllers() {
  const auto shipped = module<Controller>(kModules, "pursuit_dwa");
  return {wrapped<Controller, BlindController>("sees no obstacles", shipped),
          wrapped<Controller, StubbornController>("keeps the first path", shipped),
          wrapped<Controller, HastyController>("too fast", shipped)};
}

INSTANTIATE_TEST_SUITE_P(Faulty, ControllerConformance, testing::ValuesIn(faulty_controllers()));

}  // namespace
}  // namespace cairn::conformance
