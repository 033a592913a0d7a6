#define PIN_LED   PIN_D13
#define PIN_A1    (27ul)
