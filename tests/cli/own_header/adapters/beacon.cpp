//# header beacon.h

//# adapter beacon_flash
//#   for: void beacon_flash(int pin, int times)
//#   kind: oneToMany
//#   pin: pin digital out
//#   fidelity: 100 ms on, 100 ms off
inline void beacon_flash(int32_t pin, int32_t times) {
  pinMode(pin, OUTPUT);
  while (times-- > 0) {
    digitalWrite(pin, HIGH);
    delay(100);
    digitalWrite(pin, LOW);
    delay(100);
  }
}
