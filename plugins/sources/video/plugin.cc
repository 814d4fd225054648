#include "plaza/plugin.h"

#include "plugins/sources/video/video_source.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::sources::VideoSource>(); }
