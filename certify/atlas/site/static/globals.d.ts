// For the type checker alone: what other scripts of a page define.
declare const TETRAHEDRA: Record<string, string[]>;
declare const Plotly: any;
