#include <stdio.h>
#include <stdint.h>
int main() { uint16_t n = 3; char *p = NULL; printf("%d %s", n, p); return 0; }
