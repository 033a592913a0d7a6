static int sum;
static void high(int number);
void b(void) { high(3); }
static void high(int number) { sum += number; }
