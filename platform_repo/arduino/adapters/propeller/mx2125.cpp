//# header mx2125.h
// An accelerometer of two axes with pulses. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Sensor/libmx2125.

//# adapter mx_accel
//#   for: int mx_accel(int axisPin)
//#   kind: oneToOne
//#   needs: simpletools.h/pulse_in
//#   pin: axisPin digital in
//#   fidelity: microseconds of the next pulse less 5,000, as there: 1,250 for 1 g
//#   stack: 59 46
inline int32_t mx_accel(int32_t axisPin) {
  return pulse_in(axisPin, 1) - 5000;
}

//# adapter mx_rotate
//#   for: int mx_rotate(int xPin, int yPin)
//#   kind: oneToOne
//#   needs: mx_accel
//#   pin: xPin digital in
//#   pin: yPin digital in
//#   fidelity: whole degrees from 0 to 359, towards 0 before those below 0 are turned round, as there
//#   stack: 69 59
inline int32_t mx_rotate(int32_t xPin, int32_t yPin) {
  int32_t x = mx_accel(xPin), y = mx_accel(yPin);
  int32_t degrees = (int32_t)(atan2((float)y, (float)x) * 180.0f / 3.14159265f);
  return degrees < 0 ? 360 + degrees : degrees;
}

//# adapter mx_tilt
//#   for: int mx_tilt(int axisPin)
//#   kind: oneToOne
//#   needs: mx_accel
//#   pin: axisPin digital in
//#   fidelity: whole degrees from -90 to 90, towards 0, as there
//#   stack: 65 59
inline int32_t mx_tilt(int32_t axisPin) {
  float part = constrain((float)mx_accel(axisPin), -1250.0f, 1250.0f) / 1250.0f;
  return (int32_t)(asin(part) * 180.0f / 3.14159265f);
}
