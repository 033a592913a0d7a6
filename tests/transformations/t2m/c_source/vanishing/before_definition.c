int main() { cogstart(&blink, NULL, stack, sizeof(stack)); later(1); }
int stack[40];
void later(int pin) { high(pin); }
void blink(void *par) { low(3); }
/* expect: cogstart later high low */
