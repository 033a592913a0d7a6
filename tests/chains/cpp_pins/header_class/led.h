#ifndef LED_H
#define LED_H
class Led {
  int pin;
public:
  Led(int p);
  void on();
};
#endif
