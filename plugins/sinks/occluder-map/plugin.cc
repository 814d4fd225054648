#include "plaza/plugin.h"

#include "plugins/sinks/occluder-map/occluder_map.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::occluder_map::OccluderMap>(); }
