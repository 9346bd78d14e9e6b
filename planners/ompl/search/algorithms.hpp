// The planners of OMPL 1.5.2 that may be named: those that run in one thread and whose answer hangs on
// seed and iterations alone. PRM and PRM* run without their second thread and their clock (counted_prm).
// Left out: pRRT, pSBL, CForest, SPARS, AnytimePathShortening (threads), LazyPRM and LazyPRM* (do not obey
// their termination condition in that version), SORRT* (loses memory), LBKPIECE1 (finds next to nothing here), PDST
// (takes up to 50 ms to give its memory back after 3000 iterations, past any deadline). AnyAngleRRTstar is ours: the
// shortest route over the cells, improved by InformedRRTstar.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace cairn {

enum class Algorithm {
  any_angle_rrt_star,
  abit_star,
  ait_star,
  bfmt,
  bi_est,
  bi_trrt,
  bit_star,
  bkpiece,
  est,
  fmt,
  informed_rrt_star,
  kpiece,
  lazy_rrt,
  lbt_rrt,
  prm,
  prm_star,
  proj_est,
  rrt,
  rrt_connect,
  rrt_sharp,
  rrt_star,
  rrt_x_static,
  sbl,
  stride,
  trrt,
};

// As files name them, which is as OMPL does.
[[nodiscard]] inline std::vector<std::pair<std::string, Algorithm>> algorithm_names() {
  using enum Algorithm;
  return {{"AnyAngleRRTstar", any_angle_rrt_star},
          {"BITstar", bit_star},
          {"ABITstar", abit_star},
          {"AITstar", ait_star},
          {"RRTConnect", rrt_connect},
          {"RRT", rrt},
          {"RRTstar", rrt_star},
          {"InformedRRTstar", informed_rrt_star},
          {"RRTsharp", rrt_sharp},
          {"RRTXstatic", rrt_x_static},
          {"LBTRRT", lbt_rrt},
          {"LazyRRT", lazy_rrt},
          {"TRRT", trrt},
          {"BiTRRT", bi_trrt},
          {"PRM", prm},
          {"PRMstar", prm_star},
          {"FMT", fmt},
          {"BFMT", bfmt},
          {"EST", est},
          {"BiEST", bi_est},
          {"ProjEST", proj_est},
          {"KPIECE1", kpiece},
          {"BKPIECE1", bkpiece},
          {"SBL", sbl},
          {"STRIDE", stride}};
}

}  // namespace cairn
