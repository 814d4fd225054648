#include "plaza/plugin.h"

#include "plugins/sinks/reliability-diagram/reliability_diagram.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::reliability_diagram::ReliabilityDiagram>(); }
