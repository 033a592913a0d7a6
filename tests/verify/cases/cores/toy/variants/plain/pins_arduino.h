#define LAMP_PIN 5
