// What the server answers about dives and what was sampled on them.

export type {
  DensityLine,
  DiagramAnswer,
  DiveRow,
  ProfileAnswer,
  ProfileRow,
  SectionAnswer,
} from '../../lib/types';
