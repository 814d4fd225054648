#define PLAZA_ROW_KERNELS kAvx2Kernels
#define PLAZA_ROW_KERNELS_NAME "avx2"
#include "modalities/color/row_kernels.inl"
