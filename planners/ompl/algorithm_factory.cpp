#include "planners/ompl/algorithm_factory.hpp"

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

#include "planners/ompl/counted_prm.hpp"
#include "planners/ompl/seeded_rrt_star.hpp"

namespace cairn {

namespace og = ompl::geometric;

// One line an algorithm.
// NOLINTNEXTLINE(readability-function-size)
ompl::base::PlannerPtr make_algorithm(Algorithm algorithm, const ompl::base::SpaceInformationPtr& space) {
  switch (algorithm) {
    case Algorithm::any_angle_rrt_star:
      return std::make_shared<SeededRrtStar>(space);
    case Algorithm::abit_star:
      return std::make_shared<og::ABITstar>(space);
    case Algorithm::ait_star:
      return std::make_shared<og::AITstar>(space);
    case Algorithm::bfmt:
      return std::make_shared<og::BFMT>(space);
    case Algorithm::bi_est:
      return std::make_shared<og::BiEST>(space);
    case Algorithm::bit_star:
      return std::make_shared<og::BITstar>(space);
    case Algorithm::bi_trrt:
      return std::make_shared<og::BiTRRT>(space);
    case Algorithm::bkpiece:
      return std::make_shared<og::BKPIECE1>(space);
    case Algorithm::est:
      return std::make_shared<og::EST>(space);
    case Algorithm::fmt:
      return std::make_shared<og::FMT>(space);
    case Algorithm::informed_rrt_star:
      return std::make_shared<og::InformedRRTstar>(space);
    case Algorithm::kpiece:
      return std::make_shared<og::KPIECE1>(space);
    case Algorithm::lazy_rrt:
      return std::make_shared<og::LazyRRT>(space);
    case Algorithm::lbt_rrt:
      return std::make_shared<og::LBTRRT>(space);
    case Algorithm::prm:
      return std::make_shared<CountedPrm>(space, CountedPrm::Stop::at_first_route);
    case Algorithm::prm_star:
      return std::make_shared<CountedPrm>(space, CountedPrm::Stop::when_told);
    case Algorithm::proj_est:
      return std::make_shared<og::ProjEST>(space);
    case Algorithm::rrt:
      return std::make_shared<og::RRT>(space);
    case Algorithm::rrt_connect:
      return std::make_shared<og::RRTConnect>(space);
    case Algorithm::rrt_sharp:
      return std::make_shared<og::RRTsharp>(space);
    case Algorithm::rrt_star:
      return std::make_shared<og::RRTstar>(space);
    case Algorithm::rrt_x_static:
      return std::make_shared<og::RRTXstatic>(space);
    case Algorithm::sbl:
      return std::make_shared<og::SBL>(space);
    case Algorithm::stride:
      return std::make_shared<og::STRIDE>(space);
    case Algorithm::trrt:
      return std::make_shared<og::TRRT>(space);
  }
  throw std::logic_error("no OMPL planner for algorithm " + std::to_string(static_cast<int>(algorithm)));
}

}  // namespace cairn
