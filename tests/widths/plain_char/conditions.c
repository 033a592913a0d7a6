#include "simpletools.h"
#define K '\x80'
#if K > 0
int a;
#endif
#if 'a' == 97 && '\n' == 10 && '\'' == 39
int b;
#endif
#if true
int c;
#endif
#if 'ab' > 0
int d;
#endif
int main(void) { while(1) pause(1); }
