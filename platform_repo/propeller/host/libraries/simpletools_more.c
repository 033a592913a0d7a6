/* simpletools.h: cogs by their address, terminal commands, EEPROM, arithmetic. Sources: libsimpletools/source (cogrun.c, eeprom_*.c,
 * i2c_*.c, mapInt.c, random.c, term_cmd.c and their neighbours). */
#include "simpletools.h"

/* ---- cogs */

int *cog_run(void (*function)(void *par), int stacksize) {
  int *place = malloc(4 + 176 + stacksize * 4);
  host_call();
  if (!place) return 0;
  *place = host_start(function, 0, -1) + 1;
  if (*place) return place;
  free(place);
  return 0;
}

int cog_num(int *coginfo) {
  host_call();
  return *coginfo - 1;
}

void cog_end(int *coginfo) {
  host_call();
  int number = *coginfo - 1;
  *coginfo = 0;
  if (number < 0) return;
  free(coginfo);
  host_stop(number);
}

/* ---- terminal */

void term_cmd(int termConst, ...) {
  int count = termConst == CRSRXY ? 2 : termConst == CRSRX || termConst == CRSRY ? 1 : 0;
  va_list values;
  text_t *terminal = simpleterm_pointer();
  serial_txChar(terminal, termConst);
  va_start(values, termConst);
  while (count--) serial_txChar(terminal, va_arg(values, int));
  va_end(values);
}

/* ---- the two-wire bus and the EEPROM on it */

enum { BUSES = 8 };
unsigned int st_buscnt;
i2c *st_eeprom;
int st_eeInitFlag;

i2c *i2c_newbus(int sclPin, int sdaPin, int sclDrive) {
  static i2c buses[BUSES];
  host_call();
  if (st_buscnt >= BUSES) host_end("crashed", "opens more than eight buses");
  return i2c_open(&buses[st_buscnt++], sclPin, sdaPin, sclDrive);
}

/* The register's address: highest byte first for a positive count, as it lies in memory for a negative one. */
static int put_address(i2c *bus, int address, int count) {
  unsigned char bytes[4];
  int size = count < 0 ? -count : count;
  memcpy(bytes, &address, 4);
  if (count > 0) endianSwap(bytes, &address, size);
  return i2c_writeData(bus, bytes, size);
}

int i2c_out(i2c *busID, int i2cAddr, int memAddr, int memAddrCount, const unsigned char *data, int dataCount) {
  int done = 1, size = dataCount < 0 ? -dataCount : dataCount;
  i2c_start(busID);
  if (i2c_writeByte(busID, i2cAddr << 1)) return 0;
  if (memAddrCount) done += put_address(busID, memAddr, memAddrCount);
  if (dataCount > 0) done += i2c_writeData(busID, data, size);
  else if (dataCount < 0) {
    unsigned char turned[size];
    endianSwap(turned, (void *)data, size);
    done += i2c_writeData(busID, turned, size);
  }
  i2c_stop(busID);
  return done;
}

int i2c_in(i2c *busID, int i2cAddr, int memAddr, int memAddrCount, unsigned char *data, int dataCount) {
  int done = 1, size = dataCount < 0 ? -dataCount : dataCount;
  i2c_start(busID);
  if (i2c_writeByte(busID, i2cAddr << 1)) return 0;
  if (memAddrCount) done += put_address(busID, memAddr, memAddrCount);
  i2c_start(busID);
  if (i2c_writeByte(busID, i2cAddr << 1 | 1)) return done;
  done += 1 + i2c_readData(busID, data, size);
  i2c_stop(busID);
  if (dataCount < 0) {
    unsigned char turned[size];
    memcpy(turned, data, size);
    endianSwap(data, turned, size);
  }
  return done;
}

int i2c_busy(i2c *busID, int i2cAddr) { return i2c_poll(busID, i2cAddr << 1); }

static i2c *eeprom(void) {
  if (!st_eeInitFlag) ee_config(28, 29, 0);
  return st_eeprom;
}

void ee_config(int sclPin, int sdaPin, int sclDrive) {
  st_eeprom = i2c_newbus(sclPin, sdaPin, sclDrive);
  st_eeInitFlag = 1;
}

void ee_putStr(unsigned char *s, int n, int addr) {
  enum { PAGE_BYTES = 128 };
  while (n > 0) {
    int size = PAGE_BYTES - addr % PAGE_BYTES;
    if (size > n) size = n;
    i2c_out(eeprom(), EEPROM_ADDR, addr, 2, s, size);
    while (i2c_poll(eeprom(), EEPROM_ADDR << 1)) host_call();
    n -= size, addr += size, s += size;
  }
}

unsigned char *ee_getStr(unsigned char *s, int n, int addr) {
  i2c_in(eeprom(), EEPROM_ADDR, addr, 2, s, n);
  return s;
}

void ee_putByte(unsigned char value, int addr) { ee_putStr(&value, 1, addr); }

char ee_getByte(int addr) {
  unsigned char value = 0;
  ee_getStr(&value, 1, addr);
  return value;
}

void ee_putInt(int value, int addr) { ee_putStr((unsigned char *)&value, 4, addr); }

int ee_getInt(int addr) {
  int value = 0;
  ee_getStr((unsigned char *)&value, 4, addr);
  return value;
}

void ee_putFloat32(float value, int addr) { ee_putStr((unsigned char *)&value, 4, addr); }

float ee_getFloat32(int addr) {
  float value = 0;
  ee_getStr((unsigned char *)&value, 4, addr);
  return value;
}

/* ---- arithmetic */

int constrainInt(int value, int min, int max) {
  int least = min < max ? min : max, most = min < max ? max : min;
  return value < least ? least : value > most ? most : value;
}

float constrainFloat(float value, float min, float max) {
  float least = min < max ? min : max, most = min < max ? max : min;
  return value < least ? least : value > most ? most : value;
}

int mapInt(int value, int fromMin, int fromMax, int toMin, int toMax) {
  int product = (value - fromMin) * (toMax - toMin), span = fromMax - fromMin, half = span / 2;
  if ((product > 0 && span < 0) || (product < 0 && span > 0)) half = -half;
  return (product + half) / span + toMin;
}

float mapFloat(float value, float fromMin, float fromMax, float toMin, float toMax) {
  return (value - fromMin) * (toMax - toMin) / (fromMax - fromMin) + toMin;
}

void endianSwap(void *resultAddr, void *varAddr, int byteCount) {
  unsigned char *to = resultAddr, *from = varAddr;
  for (int i = 0; i < byteCount; i++) to[i] = from[byteCount - 1 - i];
}

/* Seeded from the pins and the counter, whose value at that moment no program knows: another one in each varied run. */
int random(int limitLow, int limitHigh) {
  static int seeded;
  if (!seeded) srand(host_random() << 15 | host_random());
  seeded = 1;
  int least = limitLow < limitHigh ? limitLow : limitHigh, most = limitLow < limitHigh ? limitHigh : limitLow;
  host_call();
  return least + rand() % (most + 1 - least);
}
