#include "plaza/plugin.h"

#include "plugins/detectors/onnx/onnx_detector.h"

PLAZA_PLUGIN(registrar) { registrar.add<plaza::OnnxDetector>(); }
