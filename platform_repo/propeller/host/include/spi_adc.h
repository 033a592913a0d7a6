/* spi_adc.h of the Simple Libraries: converters of two channels on four wires. */
#ifndef ROBOSMI_SPI_ADC_H
#define ROBOSMI_SPI_ADC_H
#include "simpletools.h"
float MCP3202_getVolts(int ch, int mosi, int miso, int clk, int csin, float vref);
float MCP3002_getVolts(int ch, int mosi, int miso, int clk, int csin, float vref);
float spi_adc(int ch, int mosi, int miso, int clk, int csin, float vref, int bits);
#endif
