#include "planners/ompl/search/algorithm_factory.hpp"

#include <fmt/format.h>
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/est/ProjEST.h>
#include <ompl/geometric/planners/fmt/BFMT.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/BKPIECE1.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/rrt/BiTRRT.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/LBTRRT.h>
#include <ompl/geometric/planners/rrt/LazyRRT.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTXstatic.h>
#include <ompl/geometric/planners/rrt/RRTsharp.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/rrt/TRRT.h>
#include <ompl/geometric/planners/sbl/SBL.h>
#include <ompl/geometric/planners/stride/STRIDE.h>

#include <stdexcept>
#include <utility>

#include "planners/ompl/disc/seeded_rrt_star.hpp"
#include "planners/ompl/search/counted_prm.hpp"

namespace cairn {

namespace {

namespace og = ompl::geometric;
using ompl::base::PlannerPtr;
using Space = ompl::base::SpaceInformationPtr;

template <class Planner>
PlannerPtr made(const Space& space) {
  return std::make_shared<Planner>(space);
}
template <CountedPrm::Stop stop>
PlannerPtr made_prm(const Space& space) {
  return std::make_shared<CountedPrm>(space, stop);
}

constexpr std::pair<Algorithm, PlannerPtr (*)(const Space&)> kMakers[] = {
    {Algorithm::any_angle_rrt_star, made<SeededRrtStar>},
    {Algorithm::abit_star, made<og::ABITstar>},
    {Algorithm::ait_star, made<og::AITstar>},
    {Algorithm::bfmt, made<og::BFMT>},
    {Algorithm::bi_est, made<og::BiEST>},
    {Algorithm::bit_star, made<og::BITstar>},
    {Algorithm::bi_trrt, made<og::BiTRRT>},
    {Algorithm::bkpiece, made<og::BKPIECE1>},
    {Algorithm::est, made<og::EST>},
    {Algorithm::fmt, made<og::FMT>},
    {Algorithm::informed_rrt_star, made<og::InformedRRTstar>},
    {Algorithm::kpiece, made<og::KPIECE1>},
    {Algorithm::lazy_rrt, made<og::LazyRRT>},
    {Algorithm::lbt_rrt, made<og::LBTRRT>},
    {Algorithm::prm, made_prm<CountedPrm::Stop::at_first_route>},
    {Algorithm::prm_star, made_prm<CountedPrm::Stop::when_told>},
    {Algorithm::proj_est, made<og::ProjEST>},
    {Algorithm::rrt, made<og::RRT>},
    {Algorithm::rrt_connect, made<og::RRTConnect>},
    {Algorithm::rrt_sharp, made<og::RRTsharp>},
    {Algorithm::rrt_star, made<og::RRTstar>},
    {Algorithm::rrt_x_static, made<og::RRTXstatic>},
    {Algorithm::sbl, made<og::SBL>},
    {Algorithm::stride, made<og::STRIDE>},
    {Algorithm::trrt, made<og::TRRT>},
};

}  // namespace

PlannerPtr make_algorithm(Algorithm algorithm, const Space& space) {
  for (const auto& [name, maker] : kMakers)
    if (name == algorithm) return maker(space);
  throw std::logic_error(fmt::format("no OMPL planner for algorithm {}", static_cast<int>(algorithm)));
}

}  // namespace cairn
