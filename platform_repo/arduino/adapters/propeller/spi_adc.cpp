//# header spi_adc.h
// Converters MCP3002 and MCP3202 of two channels, on four wires. Read from Simple-Libraries 1cc167c10,
// Learn/Simple Libraries/Convert/libspi_adc (spi_adc.c).

//# adapter spi_adc
//#   for: float spi_adc(int ch, int mosi, int miso, int clk, int csin, float vref, int bits)
//#   kind: oneToMany
//#   needs: simpletools.h/shift_out simpletools.h/shift_in simpletools.h/MSBPOST simpletools.h/low simpletools.h/high simpletext.h/print
//#   pin: mosi digital out
//#   pin: miso digital in
//#   pin: clk digital out
//#   pin: csin digital out
//#   fidelity: exact: channel 0 or, for any other number, 1, against ground; a negative reference is said at the terminal, and -99.99
//#   stack: 298 252
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline float spi_adc(int32_t ch, int32_t mosi, int32_t miso, int32_t clk, int32_t csin, float vref, int32_t bits) {
  if (vref < 0) {
    print("Error! Float Vref = %f, should not be <= 0\n", vref);
    return -99.99f;
  }
  high(csin);
  low(csin);
  shift_out(mosi, clk, MSBFIRST, 4, ch ? 0xF : 0xD);
  int16_t value = shift_in(miso, clk, MSBPOST, bits);
  high(csin);
  delayMicroseconds(5);
  shift_out(mosi, clk, MSBFIRST, 1, 1);
  return value * vref / (1UL << bits);
}

//# adapter MCP3202_getVolts
//#   for: float MCP3202_getVolts(int ch, int mosi, int miso, int clk, int csin, float vref)
//#   kind: oneToOne
//#   needs: spi_adc
//#   pin: mosi digital out
//#   pin: miso digital in
//#   pin: clk digital out
//#   pin: csin digital out
//#   fidelity: exact: 12 bits
//#   stack: 290 252
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline float MCP3202_getVolts(int32_t ch, int32_t mosi, int32_t miso, int32_t clk, int32_t csin, float vref) {
  return spi_adc(ch, mosi, miso, clk, csin, vref, 12);
}

//# adapter MCP3002_getVolts
//#   for: float MCP3002_getVolts(int ch, int mosi, int miso, int clk, int csin, float vref)
//#   kind: oneToOne
//#   needs: spi_adc
//#   pin: mosi digital out
//#   pin: miso digital in
//#   pin: clk digital out
//#   pin: csin digital out
//#   fidelity: exact: 10 bits
//#   stack: 290 252
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline float MCP3002_getVolts(int32_t ch, int32_t mosi, int32_t miso, int32_t clk, int32_t csin, float vref) {
  return spi_adc(ch, mosi, miso, clk, csin, vref, 10);
}
