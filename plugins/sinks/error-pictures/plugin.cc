#include "plaza/plugin.h"

#include "plugins/sinks/error-pictures/error_pictures.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::error_pictures::ErrorPictures>(); }
