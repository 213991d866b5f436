declare module "virtual:module" {
  const packed: string;
  export default packed;
}
declare module "virtual:worker" {
  const text: string;
  export default text;
}
declare module "virtual:style" {
  const text: string;
  export default text;
}
