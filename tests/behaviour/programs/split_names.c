#include <stdio.h>
int cou\
nter = 40000;
int main() { coun\
ter++; printf("%d\n", counter); return co\
unter > 3 ? 0 : 1; }
