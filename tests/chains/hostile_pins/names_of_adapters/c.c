static int sum;
#define low(number) (sum -= (number))
void c(void) { low(3); }
