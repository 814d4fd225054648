#include "plaza/plugin.h"

#include "modalities/edges/edges.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::edges::Edges>(); }
