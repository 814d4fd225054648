#include "plaza/plugin.h"

#include "plugins/sinks/image-data-set/image_data_set.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::data_set::ImageDataSet>(); }
