HUBDATA int first = START_VALUE;
int pins[PIN_COUNT];
static FLASH_SPACE uint8_t table[] = { A_FLAG, B_FLAG };
int main() { first = adc_volts(0) * 100; return get_it(table[0]); }
/* expect: adc_volts get_it */
