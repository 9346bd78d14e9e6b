// The planners of OMPL 1.5.2 that may be named: those that run in one thread and whose answer hangs on
// seed and iterations alone. Left out: pRRT, pSBL, CForest, SPARS, AnytimePathShortening (threads),
// LazyPRM and LazyPRM* (neither heeds its termination condition in that version). PRM and PRM* run
// without their second thread and their clock.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace cairn {

enum class Algorithm {
  abit_star, ait_star, bfmt, bi_est, bit_star, bi_trrt, bkpiece, est, fmt, informed_rrt_star, kpiece, lazy_rrt,
  lbt_rrt, pdst, prm, prm_star, proj_est, rrt, rrt_connect, rrt_sharp, rrt_star, rrt_x_static, sbl,
  sorrt_star, stride, trrt,
};

// As files name them, which is as OMPL does.
[[nodiscard]] inline std::vector<std::pair<std::string, Algorithm>> algorithm_names() {
  using enum Algorithm;
  return {{"RRTConnect", rrt_connect}, {"BITstar", bit_star},     {"ABITstar", abit_star},
          {"AITstar", ait_star},       {"RRTstar", rrt_star},     {"InformedRRTstar", informed_rrt_star},
          {"SORRTstar", sorrt_star},   {"RRTsharp", rrt_sharp},   {"RRTXstatic", rrt_x_static},
          {"LBTRRT", lbt_rrt},         {"PRM", prm},              {"PRMstar", prm_star},
          {"FMT", fmt},                {"BFMT", bfmt},            {"RRT", rrt},
          {"LazyRRT", lazy_rrt},       {"TRRT", trrt},            {"BiTRRT", bi_trrt},
          {"EST", est},                {"BiEST", bi_est},         {"ProjEST", proj_est},
          {"KPIECE1", kpiece},         {"BKPIECE1", bkpiece},    
          {"SBL", sbl},                {"STRIDE", stride},        {"PDST", pdst}};
}

}  // namespace cairn
