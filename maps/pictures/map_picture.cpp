#include "maps/occupancy_grid.hpp"
