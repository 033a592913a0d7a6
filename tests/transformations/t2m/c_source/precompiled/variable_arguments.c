#include "board.h"
int sum(int n, ...) { va_list all; va_start(all, n); int first = va_arg(all, int); va_end(all); return first; }
int main() { return sum(2, LED, 3); }
