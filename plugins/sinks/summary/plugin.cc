#include "plaza/plugin.h"

#include "plugins/sinks/summary/summary.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::summary::Summary>(); }
