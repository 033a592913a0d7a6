#define BESIDE 12
int own_function(int pin);
