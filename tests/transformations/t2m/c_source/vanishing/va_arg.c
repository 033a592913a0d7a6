#include "simpletools.h"
void all(int n, ...) { va_list args; va_start(args, n); putChar(va_arg(args, int)); va_end(args); }
/* expect: va_start putChar va_arg va_end */
