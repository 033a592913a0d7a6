//# header octo.h

//# adapter turn_on
//#   for: void turn_on(int pin)
//#   kind: oneToMany
//#   pin: pin digital out
//#   fidelity: the pin is high
inline void turn_on(int16_t pin) {
  pinMode(pin, OUTPUT);
  digitalWrite(pin, HIGH);
}

//# adapter turn_off
//#   for: void turn_off(int pin)
//#   kind: oneToMany
//#   pin: pin digital out
//#   fidelity: the pin is low
inline void turn_off(int16_t pin) {
  pinMode(pin, OUTPUT);
  digitalWrite(pin, LOW);
}

//# adapter is_on
//#   for: int is_on(int pin)
//#   kind: oneToMany
//#   pin: pin digital in
//#   fidelity: 1 at a high input, else 0
inline int16_t is_on(int16_t pin) {
  pinMode(pin, INPUT);
  return digitalRead(pin);
}

//# adapter wait_ms
//#   for: void wait_ms(unsigned int ms)
//#   kind: oneToOne
//#   fidelity: milliseconds
inline void wait_ms(uint16_t ms) {
  delay(ms);
}
