#include "plaza/plugin.h"

#include "plugins/sources/images/images_source.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::sources::ImagesSource>(); }
