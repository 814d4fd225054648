#include "plaza/plugin.h"

#include "plugins/sources/synthetic/synthetic_source.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::synthetic::SyntheticSource>(); }
