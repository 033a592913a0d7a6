#include <stdio.h>
int mode;
int level, peak;
int next(void);
int main(void) { mode++; printf("%d %d %d %d\n", mode, level, peak, next()); return 0; }
