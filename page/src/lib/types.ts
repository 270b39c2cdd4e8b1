// What the station answers, from its own document (schema.d.ts, by `npm run types`), under the page's names.

import type { LiveMessage, Refusal as WholeRefusal } from './schema';

export type {
  AlarmRow,
  AlertInfo,
  AlertTried,
  AuditEntry as AuditRow,
  Asking as User,
  ChannelInfo as Channel,
  CommandKind,
  CommandParameter,
  CommandState,
  ComponentParameters,
  Comparison,
  Current,
  Dive as DiveRow,
  FolderAnswer,
  FolderEntry,
  Frame,
  Hold,
  HolderInfo,
  KeptLimit,
  Latest,
  LayerRow,
  Limit,
  LinkAnswer,
  LinkFigures,
  LiveMessage,
  LiveRequest,
  LogEntry,
  LogPage,
  Job,
  Mission,
  MissionAboard,
  MissionDetail,
  NewMission,
  Parameter,
  ParameterAnswer,
  OpenAbort,
  ParameterWrite,
  Person,
  PlanField,
  Preview,
  Profile as ProfileAnswer,
  ProfileLine as ProfileRow,
  Role,
  Section as SectionAnswer,
  Sentence,
  SeriesAnswer,
  Shape,
  StateMachine,
  StationInfo,
  StoredFile,
  StoredLog,
  Token,
  TokenMade,
  TrackAnswer as Track,
  Transfer,
  Waiting,
  VehicleAlarm as AlarmBrief,
  VehicleDetail,
  VehiclePosition as Position,
  VehicleSummary,
  DensityLine,
  Diagram as DiagramAnswer,
} from './schema';

export type { Command as GivenCommand, CommandDetail } from './schema';

/** A vehicle's number, or "replay:ID" for what a replay says on the live socket. */
export type VehicleKey = number | string;

/** What happened, as the live socket tells it. */
export type StationEvent = Extract<LiveMessage, { type: 'event' }>;
export type EventKind = StationEvent['kind'];

/** What the server says when it refuses: a sentence, and what would be allowed. */
export type Refusal = Pick<WholeRefusal, 'reason'> & Partial<WholeRefusal>;
