// Who sits here, and what the station is called.

import { api, onSignedOut, sentence } from './api';
import type { Role, StationInfo, User } from './types';

const RANK: Record<Role, number> = { viewer: 0, pilot: 1, admin: 2 };

class Session {
  station = $state.raw<StationInfo | undefined>(undefined);
  reason = $state<string | undefined>(undefined);
  asked = $state(false);

  constructor() {
    onSignedOut(() => {
      if (this.station?.user) this.station = { ...this.station, user: null };
    });
  }

  get user(): User | null {
    return this.station?.user ?? null;
  }

  /** Whether the page has to show the sign-in form. */
  get mustSignIn(): boolean {
    return this.station !== undefined && this.station.login_required && this.station.user === null;
  }

  may(role: Role): boolean {
    const user = this.user;
    if (user) return RANK[user.role] >= RANK[role];
    return this.station !== undefined && !this.station.login_required;
  }

  async load(): Promise<void> {
    try {
      this.station = await api.get<StationInfo>('/station');
      this.reason = undefined;
    } catch (error) {
      this.reason = sentence(error);
    }
    this.asked = true;
  }

  async signIn(name: string, password: string): Promise<void> {
    await api.post('/session', { name, password });
    await this.load();
  }

  async signOut(): Promise<void> {
    await api.delete('/session');
    await this.load();
  }
}

export const session = new Session();
