// Position of the sun from the latitude, the day and the solar time.

const degrees = Math.PI / 180;
// Declination of the sun at the days of the list in texts.js.
const declinations = [0, 23.44 * degrees, -23.44 * degrees];

// Returns the direction to the sun as a unit vector: x to the east, y to the north, z up. Duffie and Beckman (2013),
// chapter 1.6.
export function sunDirection(latitude, day, hour) {
  const phi = latitude * degrees;
  const declination = declinations[day];
  const angle = (hour - 12) * 15 * degrees;
  return [
    -Math.cos(declination) * Math.sin(angle),
    Math.cos(phi) * Math.sin(declination) - Math.sin(phi) * Math.cos(declination) * Math.cos(angle),
    Math.sin(phi) * Math.sin(declination) + Math.cos(phi) * Math.cos(declination) * Math.cos(angle),
  ];
}
