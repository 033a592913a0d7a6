#include "simpletools.h"
int p = 8;
int pick(int a){ return a ?: 3; }
int main(){ int q = 4; int n = input(3) ?: 2; high(q ?: 5); low(pick(p)); while(1){ int m = (n > 2) ?: input(5); high(0); pause(30*n ?: 7); low(0); pause(m ?: n ?: 3); switch(n ?: 2){ case 1: high(6 ?: 1); } } }
