//# header ping.h
// Ultrasonic ranger with one pin, or with two where it is drawn so. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Sensor/libping.

//# adapter ping
//#   for: int ping(int pin)
//#   kind: oneToMany
//#   needs: simpletools.h/asking simpletools.h/low simpletools.h/pulse_out simpletools.h/pulse_in
//#   role: ranger
//#   pin: pin digital both split ranger
//#   fidelity: microseconds of the echo; 0 without an echo
//#   stack: 59 46
inline int32_t ping(int32_t pin) {
  int32_t out = asking(pin);
  delay(1);
  low(out);
  pulse_out(out, 10);
  return pulse_in(answering(pin), 1);
}

//# adapter ping_cm
//#   for: int ping_cm(int pin)
//#   kind: oneToOne
//#   needs: ping
//#   role: ranger
//#   pin: pin digital both split ranger
//#   fidelity: whole centimetres, rounded down
//#   stack: 59 46
inline int32_t ping_cm(int32_t pin) {
  return ping(pin) / 58;
}

//# adapter ping_inches
//#   for: int ping_inches(int pin)
//#   kind: oneToOne
//#   needs: ping
//#   role: ranger
//#   pin: pin digital both split ranger
//#   fidelity: whole inches, rounded down
//#   stack: 59 46
inline int32_t ping_inches(int32_t pin) {
  return ping(pin) / 148;
}
