#include "plaza/plugin.h"

#include "plugins/associators/gnn/gnn.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::Gnn>(); }
