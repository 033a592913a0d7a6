/* The rest of a program that blinks; without headers, so that an attack may declare any name. */
void high(int pin);
void low(int pin);
void pause(int ms, ...);
int main(void) { high(3); pause(20); low(3); pause(20); return 0; }
