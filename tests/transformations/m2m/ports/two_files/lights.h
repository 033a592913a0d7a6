#ifndef LIGHTS_H
#define LIGHTS_H
#define LEFT_LAMP 26  // => #define LEFT_LAMP 13
extern int eye, shown;
void flash(int pin);
int look(void);
#endif
