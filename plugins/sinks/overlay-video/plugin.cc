#include "plaza/plugin.h"

#include "plugins/sinks/overlay-video/overlay_video.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::overlay::OverlayVideo>(); }
