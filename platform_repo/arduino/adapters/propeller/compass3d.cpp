//# header compass3d.h
// A compass of three axes (HMC5883L) on the two-wire bus. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Sensor/libcompass3d.

//# adapter compass_init
//#   for: void compass_init(i2c *bus)
//#   kind: oneToOne
//#   needs: simplei2c.h/i2c simpletools.h/i2c_out
//#   fidelity: exact: it measures all the time from now on
//#   stack: 8 4
inline void compass_init(i2c *bus) {
  uint8_t continuous = 0;
  i2c_out(bus, 0x1E, 2, 1, &continuous, 1);
}

//# adapter compass_read
//#   for: void compass_read(i2c *bus, int *px, int *py, int *pz)
//#   kind: oneToOne
//#   needs: simplei2c.h/i2c simpletools.h/i2c_in
//#   fidelity: exact: the last measurement of each axis
//#   stack: 28 14
template <class Int> inline void compass_read(i2c *bus, Int *px, Int *py, Int *pz) {
  uint8_t data[6] = {};
  i2c_in(bus, 0x1E, 3, 1, data, 6);
  *px = (int16_t)((uint16_t)data[0] << 8 | data[1]);
  *pz = (int16_t)((uint16_t)data[2] << 8 | data[3]);
  *py = (int16_t)((uint16_t)data[4] << 8 | data[5]);
}
