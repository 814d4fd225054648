#include "plaza/plugin.h"

#include "plugins/detectors/hierarchical-grid/hierarchical_grid.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::HierarchicalGrid>(); }
