/* stdlib.h: that of the machine, but for the largest random number, which is a number of the library (lib/include/stdlib.h). */
#include_next <stdlib.h>
#undef RAND_MAX
#define RAND_MAX 0x7FFF
