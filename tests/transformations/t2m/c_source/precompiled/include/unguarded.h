void twice(int pin);
#define TWICE 2
