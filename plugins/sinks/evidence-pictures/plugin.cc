#include "plaza/plugin.h"

#include "plugins/sinks/evidence-pictures/evidence_pictures.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::evidence_pictures::EvidencePictures>(); }
