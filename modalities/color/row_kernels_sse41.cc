#define PLAZA_ROW_KERNELS kSse41Kernels
#define PLAZA_ROW_KERNELS_NAME "sse4.1"
#include "modalities/color/row_kernels.inl"
