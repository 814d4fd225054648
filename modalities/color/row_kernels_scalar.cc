#define PLAZA_ROW_KERNELS kScalarKernels
#define PLAZA_ROW_KERNELS_NAME "scalar"
#include "modalities/color/row_kernels.inl"
